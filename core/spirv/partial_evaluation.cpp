#include <core/spirv/partial_evaluation.hpp>

#include <core/spirv/dead_code.hpp>
#include <core/spirv/folding.hpp>
#include <core/spirv/hoisting.hpp>
#include <core/spirv/variables.hpp>
#include <core/spirv/writes.hpp>

#include <algorithm>
#include <set>
#include <utility>

namespace elvis {

namespace {

// A loop is written out within limits: of rounds, that of Mesa's gallivm, and of scalar instructions without loads and stores
// of the function's variables; with these, so that nested loops end that do nothing else. Nor is one that holds a loop that
// stays.
constexpr std::size_t most_rounds = 32;

/** For processors more than gallivm's 832: what is fetched in a loop that is written out can be fetched before those around it.
 */
constexpr std::size_t most_instructions_for(SpirvTarget target) { return target == SpirvTarget::processor ? 6000 : 832; }

/** That a kernel is left as it is. */
class NotEvaluated {};

/** How a way through the blocks ends. */
enum class End {
    /** At a block that was asked for. */
    reached,
    /** The function returns, in a block that every way out of it leads to. */
    returned,
    /** Elsewhere; the block has its terminator. */
    left,
    /** At what keeps a loop from being written out. */
    failed
};

/** The branch of a selection. */
struct Way {
    End end = End::left;
    /** The block that it ends in. */
    SpirvId label = 0;
    /** Where it returned one. */
    SpirvId returned = 0;
    /** By phi of the block where the branches meet: its value here. */
    std::map<SpirvId, SpirvId> phis;
    KnownValues::Values changed;
};

class Evaluator {
public:
    Evaluator(SpirvModule& module, SpirvTarget target)
        : m_target(target), m_most_instructions(most_instructions_for(target)), m_module(module), m_values(module),
          m_writer(module, m_values), m_variables(module, m_values, m_writer), m_writes(module), m_new_ids(module.bound()) {
        for (const SpirvInstruction& global : module.globals) {
            m_new_ids[global.result] = global.result;
        }
    }

    std::vector<std::uint32_t> evaluate() {
        m_function = &m_module.functions.at(m_module.entry_point);
        const SpirvId first = m_function->body.front().result;
        m_writer.write_label(first);
        if (run(first, {}) != End::left) {
            throw NotEvaluated();
        }
        std::vector<SpirvInstruction> body = m_writer.take();
        drop_dead_code(body, m_values);
        if (m_target == SpirvTarget::processor) {
            hoist_fetches(body);
        }
        return put_spirv_together(m_module, body, m_writer.decorations(body));
    }

private:
    // Blocks. Labels are those of the module that is evaluated, unless said otherwise.

    using Labels = std::vector<SpirvId>;

    /** From a block on, until one of `stops` is reached: `m_at`. The first block is entered, whatever it is. */
    End run_inside(SpirvId label, const Labels& stops) {
        const End end = evaluate_block(label, stops);
        return end == End::reached ? run(m_next, stops) : end;
    }

    End run(SpirvId label, const Labels& stops) {
        for (;;) {
            if (std::ranges::find(stops, label) != stops.end()) {
                m_at = label;
                return End::reached;
            }
            if (m_loop_labels.contains(label)) {
                return End::failed;
            }
            if (const auto exit = m_exits.find(label); exit != m_exits.end()) {
                m_writer.write(spirv_statement(spv::OpBranch, {exit->second}));
                return End::left;
            }
            const SpirvInstruction* merge = merge_of(label);
            const bool is_loop = merge && merge->op == spv::OpLoopMerge;
            const End end = is_loop ? evaluate_loop(label, *merge) : evaluate_block(label, stops);
            if (end != End::reached) {
                return end;
            }
            label = m_next;
        }
    }

    /** The merge instruction of a block, if it has one. */
    const SpirvInstruction* merge_of(SpirvId label) const {
        const SpirvInstruction* i = &m_function->body[m_function->blocks.at(label)];
        while (!is_terminator(i->op)) {
            if (i->op == spv::OpLoopMerge || i->op == spv::OpSelectionMerge) {
                return i;
            }
            ++i;
        }
        return nullptr;
    }

    /** Up to its terminator, and the selection that may be there. The way goes on at `m_next`. */
    End evaluate_block(SpirvId label, const Labels& stops) {
        const SpirvInstruction* i = &m_function->body[m_function->blocks.at(label)];
        for (; !is_terminator(i->op); ++i) {
            const End end = evaluate_instruction(*i);
            if (end != End::reached) {
                return end;
            }
        }
        m_last = label;
        m_joined.clear();
        switch (i->op) {
        case spv::OpBranch:
            m_next = i->words[1];
            return End::reached;
        case spv::OpBranchConditional:
            return evaluate_branch(label, *i, stops);
        case spv::OpSwitch:
            throw NotEvaluated();
        case spv::OpReturn:
        case spv::OpReturnValue:
            if (m_is_called) {
                m_returned = i->op == spv::OpReturnValue ? new_id(i->words[1]) : 0;
                return End::returned;
            }
            [[fallthrough]];
        default:
            m_writer.write(*i);
            return End::left;
        }
    }

    End evaluate_branch(SpirvId label, const SpirvInstruction& branch, const Labels& stops) {
        const SpirvId condition = new_id(branch.words[1]), yes = branch.words[2], no = branch.words[3];
        if (const auto known = m_values.number(condition)) {
            m_next = *known != 0 ? yes : no;
            return End::reached;
        }
        const SpirvInstruction* merge = merge_of(label);
        if (merge && merge->op == spv::OpSelectionMerge) {
            return evaluate_selection(condition, yes, no, merge->words[1], stops);
        }
        return leave_loop(condition, yes, no);
    }

    // Selections

    End evaluate_selection(SpirvId condition, SpirvId yes, SpirvId no, SpirvId merge, const Labels& stops) {
        const SpirvId label_yes = m_values.make_id(), label_no = m_values.make_id(), label_merge = m_values.make_id();
        m_writer.write(spirv_statement(spv::OpSelectionMerge, {label_merge}, {spv::SelectionControlMaskNone}));
        m_writer.write(spirv_statement(spv::OpBranchConditional, {condition, label_yes, label_no}));
        // What returns comes first: what is behind the selection then belongs to the other branch alone.
        const bool is_no_first = !returns(yes, {merge, no}) && returns(no, {merge, yes});
        const std::size_t moment = m_variables.known().moment();
        const SpirvId last = m_last;

        m_writer.write_label(is_no_first ? label_no : label_yes);
        const End first_end = run(is_no_first ? no : yes, {merge});
        const Way first = end_way(first_end, merge, label_merge, moment);

        m_variables.known().go_back(moment);
        m_last = last;
        m_writer.write_label(is_no_first ? label_yes : label_no);
        End second_end = run(is_no_first ? yes : no, {merge});
        if (first_end == End::returned && second_end == End::reached) {
            second_end = run(merge, stops);
        }
        const Way second = end_way(second_end, merge, label_merge, moment);
        if (first_end == End::failed || second_end == End::failed) {
            return End::failed;
        }
        m_writer.write_label(label_merge);
        m_next = merge;
        return join(first, second, moment);
    }

    /** Whether the function returns between a block and the first of those behind it. */
    bool returns(SpirvId label, const Labels& ends) const {
        if (std::ranges::find(ends, label) != ends.end()) {
            return false;
        }
        const auto first = m_function->body.begin() + static_cast<std::ptrdiff_t>(m_function->blocks.at(label));
        const auto found = std::find_if(first, m_function->body.end(), [&](const SpirvInstruction& i) {
            return i.op == spv::OpReturn || i.op == spv::OpReturnValue ||
                   (i.op == spv::OpLabel && std::ranges::find(ends, i.result) != ends.end());
        });
        return found != m_function->body.end() && found->op != spv::OpLabel;
    }

    Way end_way(End end, SpirvId merge, SpirvId label_merge, std::size_t moment) {
        Way way{end, m_writer.label(), end == End::returned ? m_returned : 0, {}, m_variables.known().changed_since(moment)};
        if (end == End::reached) {
            for (const SpirvInstruction* i = phis_of(merge); i->op == spv::OpPhi; ++i) {
                way.phis[i->result] = phi_operand(*i);
            }
        }
        if (end == End::reached || end == End::returned) {
            m_writer.write(spirv_statement(spv::OpBranch, {label_merge}));
        }
        return way;
    }

    End join(const Way& first, const Way& second, std::size_t moment) {
        if (first.end == End::left && second.end == End::left) {
            m_writer.write(spirv_statement(spv::OpUnreachable, {}));
            return End::left;
        }
        if (second.end == End::left) {
            m_variables.known().go_back(moment);
            m_variables.known().apply(first.changed);
            return join_values(first, first);
        }
        if (first.end == End::left) {
            return join_values(second, second);
        }
        m_variables.known().keep_common(moment, first.changed);
        return join_values(first, second);
    }

    End join_values(const Way& first, const Way& second) {
        if (first.end != second.end) {
            throw NotEvaluated();
        }
        m_returned =
            first.returned == second.returned ? first.returned : write_phi(first, first.returned, second, second.returned, 0);
        for (const auto& [phi, value] : first.phis) {
            const SpirvId other = second.phis.at(phi);
            m_new_ids[phi] = value == other ? value : write_phi(first, value, second, other, phi);
            m_joined.insert(phi);
        }
        return first.end;
    }

    SpirvId write_phi(const Way& first, SpirvId a, const Way& second, SpirvId b, SpirvId model) {
        return m_writer.write_expression(spirv_expression(spv::OpPhi, m_values.type_of(a), {a, first.label, b, second.label}),
                                         model);
    }

    const SpirvInstruction* phis_of(SpirvId label) const { return &m_function->body[m_function->blocks.at(label)]; }

    /** Where control comes from the last block. */
    SpirvId phi_operand(const SpirvInstruction& phi) const {
        for (std::size_t k = 3; k < phi.words.size(); k += 2) {
            if (phi.words[k + 1] == m_last) {
                return new_id(phi.words[k]);
            }
        }
        throw NotEvaluated();
    }

    // Loops

    End evaluate_loop(SpirvId header, const SpirvInstruction& merge) {
        const SpirvWriter::Mark mark = m_writer.mark();
        const std::size_t moment = m_variables.known().moment();
        const SpirvId last = m_last;
        const End end = write_out(header, merge.words[1], merge.words[2]);
        if (end != End::failed) {
            m_next = merge.words[1];
            return end;
        }
        m_writer.go_back(mark);
        m_variables.known().go_back(moment);
        m_last = last;
        keep_loop(header, merge);
        ++m_n_kept;
        m_next = merge.words[1];
        return End::reached;
    }

    /** Round by round, if it is known which is the last. */
    End write_out(SpirvId header, SpirvId after, SpirvId next) {
        const std::size_t instructions = m_instructions, size = m_writer.size(), n_kept = m_n_kept;
        m_loop_labels.insert({after, next});
        End end = End::reached;
        for (std::size_t rounds = 0; end == End::reached; ++rounds) {
            end = run_inside(header, {after, next});
            if (end == End::reached && m_at == next) {
                end = run_inside(next, {header, after});
            }
            if (end == End::reached && m_at == after) {
                break;
            }
            const bool is_long = rounds == most_rounds || m_instructions - instructions > m_most_instructions ||
                                 m_writer.size() - size > 16 * m_most_instructions || m_n_kept > n_kept;
            if (end == End::reached && is_long) {
                end = End::failed;
            }
        }
        m_loop_labels.erase(after);
        m_loop_labels.erase(next);
        m_instructions = end == End::failed ? instructions : m_instructions;
        m_n_kept = end == End::failed ? n_kept : m_n_kept;
        return end;
    }

    /** As a loop. What it writes to is not known in it. */
    void keep_loop(SpirvId header, const SpirvInstruction& merge) {
        const SpirvId after = merge.words[1], next = merge.words[2];
        for (const SpirvId written : m_writes.in(*m_function, m_function->blocks.at(header), m_function->blocks.at(after))) {
            if (m_variables.is_pointer(written)) {
                m_variables.forget(written);
            }
        }
        const SpirvId label_header = m_values.make_id(), label_body = m_values.make_id();
        const SpirvId label_next = m_values.make_id(), label_after = m_values.make_id();
        m_writer.write(spirv_statement(spv::OpBranch, {label_header}));
        m_writer.write_label(label_header);
        m_writer.write(
            spirv_statement(spv::OpLoopMerge, {label_after, label_next}, {merge.words.begin() + 3, merge.words.end()}));
        m_writer.write(spirv_statement(spv::OpBranch, {label_body}));

        const std::size_t moment = m_variables.known().moment();
        write_part(label_body, header, {{after, label_after}, {next, label_next}});
        m_variables.known().go_back(moment);
        write_part(label_next, next, {{after, label_after}, {header, label_header}});
        m_variables.known().go_back(moment);
        m_writer.write_label(label_after);
    }

    /** Of a loop that is kept: until control has left by one of these, each with its label in what is written. */
    void write_part(SpirvId label, SpirvId first, const std::map<SpirvId, SpirvId>& exits) {
        m_exits.insert(exits.begin(), exits.end());
        m_writer.write_label(label);
        if (run_inside(first, {}) != End::left) {
            throw NotEvaluated();
        }
        for (const auto& [exit, written] : exits) {
            m_exits.erase(exit);
        }
    }

    /** At the condition that ends a loop. */
    End leave_loop(SpirvId condition, SpirvId yes, SpirvId no) {
        const auto exit_yes = m_exits.find(yes), exit_no = m_exits.find(no);
        if (exit_yes == m_exits.end() && exit_no == m_exits.end()) {
            return End::failed;
        }
        const SpirvId label_yes = exit_yes != m_exits.end() ? exit_yes->second : m_values.make_id();
        const SpirvId label_no = exit_no != m_exits.end() ? exit_no->second : m_values.make_id();
        m_writer.write(spirv_statement(spv::OpBranchConditional, {condition, label_yes, label_no}));
        if (exit_yes != m_exits.end() && exit_no != m_exits.end()) {
            return End::left;
        }
        const bool goes_yes = exit_yes == m_exits.end();
        m_writer.write_label(goes_yes ? label_yes : label_no);
        m_next = goes_yes ? yes : no;
        return End::reached;
    }

    // Instructions

    End evaluate_instruction(const SpirvInstruction& i) {
        switch (i.op) {
        case spv::OpLoopMerge:
        case spv::OpSelectionMerge:
            break;
        case spv::OpFunctionCall:
            return call(i);
        case spv::OpPhi:
            if (!m_joined.contains(i.result)) {
                m_new_ids[i.result] = phi_operand(i);
            }
            break;
        case spv::OpVariable:
            m_variables.declare(i);
            if (i.words.size() > 4) {
                m_variables.store(spirv_statement(spv::OpStore, {0, 0}), i.result, new_id(i.words[4]));
            }
            break;
        case spv::OpAccessChain:
        case spv::OpInBoundsAccessChain:
            access(i);
            break;
        case spv::OpLoad:
            m_new_ids[i.result] = m_variables.load(i, check_pointer(i.words[3]));
            m_instructions += m_variables.is_local(i.words[3]) ? 0 : n_scalars(i.type);
            break;
        case spv::OpStore:
            m_variables.store(i, check_pointer(i.words[1]), new_id(i.words[2]));
            break;
        default:
            compute(i);
            break;
        }
        return End::reached;
    }

    /** Its parameters stand for the arguments, and its blocks follow. */
    End call(const SpirvInstruction& i) {
        const SpirvFunction& callee = m_module.functions.at(i.words[3]);
        for (std::size_t k = 0; k < callee.parameters.size(); ++k) {
            const SpirvId argument = i.words[4 + k];
            if (m_variables.is_pointer(argument)) {
                m_variables.pass(callee.parameters[k], argument);
            } else {
                m_new_ids[callee.parameters[k]] = new_id(argument);
            }
        }
        const SpirvFunction* caller = std::exchange(m_function, &callee);
        const bool is_called = std::exchange(m_is_called, true);
        auto joined = std::exchange(m_joined, {});
        const SpirvId last = m_last;
        const End end = run(callee.body.front().result, {});
        m_function = caller;
        m_is_called = is_called;
        m_joined = std::move(joined);
        m_last = last;
        m_new_ids[i.result] = m_returned;
        return end == End::returned ? End::reached : end;
    }

    void access(const SpirvInstruction& i) {
        const SpirvId base = check_pointer(i.words[3]);
        std::vector<SpirvId> indices;
        for (std::size_t k = 4; k < i.words.size(); ++k) {
            indices.push_back(new_id(i.words[k]));
        }
        m_variables.access(i, base, indices);
    }

    void compute(const SpirvInstruction& i) {
        SpirvInstruction made = i;
        for (const std::uint16_t k : i.operands) {
            made.words[k] = m_variables.is_pointer(i.words[k]) ? m_variables.address(i.words[k]) : new_id(i.words[k]);
        }
        if (i.result == 0) {
            m_writer.write(std::move(made));
        } else if (i.op == spv::OpCompositeExtract) {
            m_new_ids[i.result] = made.words[3];
            for (std::size_t k = 4; k < i.words.size(); ++k) {
                m_new_ids[i.result] = m_variables.extract(m_new_ids[i.result], i.words[k]);
            }
        } else if (const auto index = vector_index(made)) {
            m_new_ids[i.result] = m_variables.extract(made.words[3], *index);
        } else if (const SpirvId known = fold(made, m_values)) {
            m_new_ids[i.result] = known;
        } else {
            m_new_ids[i.result] = m_writer.write_expression(made, i.result);
            if (i.op == spv::OpCompositeConstruct) {
                m_values.note_composite(m_new_ids[i.result], made);
            } else if (i.op != spv::OpVectorShuffle) {
                m_instructions += n_scalars(i.type);
            }
        }
    }

    /** Of a vector or matrix; 1 of all else. */
    std::size_t n_scalars(SpirvId type) const {
        const std::uint32_t n = m_values.component_count(type);
        return n == 0 ? 1 : n * n_scalars(m_values.component_type(type, 0));
    }

    /** Of an element that is taken from a vector; not where that has none. */
    std::optional<std::uint32_t> vector_index(const SpirvInstruction& i) const {
        const auto index = i.op == spv::OpVectorExtractDynamic ? m_values.number(i.words[4]) : std::nullopt;
        return index && *index < m_values.component_count(m_values.type_of(i.words[3])) ? index : std::nullopt;
    }

    SpirvId new_id(SpirvId id) const {
        if (m_new_ids[id] == 0) {
            throw NotEvaluated();
        }
        return m_new_ids[id];
    }

    SpirvId check_pointer(SpirvId id) const {
        if (!m_variables.is_pointer(id)) {
            throw NotEvaluated();
        }
        return id;
    }

    SpirvTarget m_target;
    std::size_t m_most_instructions;
    SpirvModule& m_module;
    SpirvValues m_values;
    SpirvWriter m_writer;
    SpirvVariables m_variables;
    SpirvWrites m_writes;
    /** By id of the module: the value now. */
    std::vector<SpirvId> m_new_ids;

    /** Whose blocks are evaluated. */
    const SpirvFunction* m_function = nullptr;
    /** By another one. */
    bool m_is_called = false;
    /** Of loops that are kept: by label, that in what is written. */
    std::map<SpirvId, SpirvId> m_exits;
    /** Of loops that are being written out. */
    std::set<SpirvId> m_loop_labels;
    /** Phis that have their values, since branches met. */
    std::set<SpirvId> m_joined;
    SpirvId m_last = 0, m_next = 0, m_at = 0, m_returned = 0;

    /** Scalar ones that are written so far, without loads and stores of the function's variables. */
    std::size_t m_instructions = 0;
    /** Loops in what is written. */
    std::size_t m_n_kept = 0;
};

} // namespace

std::vector<std::uint32_t> evaluate_partially(std::span<const std::uint32_t> spirv, SpirvTarget target) {
    SpirvModule module = take_spirv_apart(spirv);
    try {
        return Evaluator(module, target).evaluate();
    } catch (const NotEvaluated&) {
        return {spirv.begin(), spirv.end()};
    }
}

} // namespace elvis
