#include <core/shader/argument_copies.hpp>

#include <glslang/SPIRV/spirv.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <set>

namespace elvis {

// Of the SPIR-V specification (Khronos Group): instructions and their operands.

namespace {

using Id = std::uint32_t;

constexpr std::size_t header_words = 5;
/** Of a call: before the arguments. */
constexpr std::size_t call_words = 4;

struct Instruction {
    spv::Op op;
    std::vector<std::uint32_t> words;
    bool is_dropped = false;

    bool is(spv::Op other) const { return op == other && !is_dropped; }
};

/** From OpFunction to OpFunctionEnd. */
struct Function {
    std::size_t first, end;
    std::vector<Id> parameters;
    /** By parameter. */
    std::vector<bool> is_written;
};

std::vector<Instruction> instructions_of(std::span<const std::uint32_t> spirv) {
    std::vector<Instruction> instructions;
    for (std::size_t at = header_words; at < spirv.size();) {
        const std::span<const std::uint32_t> words = spirv.subspan(at, spirv[at] >> spv::WordCountShift);
        instructions.push_back({static_cast<spv::Op>(spirv[at] & spv::OpCodeMask), {words.begin(), words.end()}});
        at += words.size();
    }
    return instructions;
}

class CopyDropper {
public:
    explicit CopyDropper(std::span<const std::uint32_t> spirv) : m_code(instructions_of(spirv)) {
        for (std::size_t i = 0; i < m_code.size(); ++i) {
            note(i);
        }
        bool has_found = true;
        while (has_found) {
            has_found = find_written();
        }
    }

    /** What is left of the code, behind its header. */
    std::vector<Instruction> drop() {
        for (const auto& [id, function] : m_functions) {
            drop_in(function);
        }
        std::erase_if(m_code, [this](const Instruction& instruction) {
            const bool is_name = instruction.op == spv::OpName || instruction.op == spv::OpMemberName;
            const bool is_of_dropped = instruction.op == spv::OpDecorate && m_dropped.contains(instruction.words[1]);
            return instruction.is_dropped || is_name || is_of_dropped;
        });
        return std::move(m_code);
    }

private:
    void note(std::size_t i) {
        const std::vector<std::uint32_t>& words = m_code[i].words;
        switch (m_code[i].op) {
        case spv::OpFunction:
            m_current = words[2];
            m_functions[m_current].first = i;
            break;
        case spv::OpFunctionParameter:
            m_functions[m_current].parameters.push_back(words[2]);
            m_functions[m_current].is_written.push_back(false);
            m_pointer_types[words[2]] = words[1];
            break;
        case spv::OpFunctionEnd:
            m_functions[m_current].end = i;
            break;
        case spv::OpVariable:
            if (words[3] == spv::StorageClassFunction) {
                m_pointer_types[words[2]] = words[1];
            }
            break;
        case spv::OpAccessChain:
        case spv::OpInBoundsAccessChain:
            m_roots[words[2]] = root(words[3]);
            break;
        default:
            break;
        }
    }

    /** The variable or parameter that a pointer leads into. */
    Id root(Id pointer) const {
        const auto found = m_roots.find(pointer);
        return found == m_roots.end() ? pointer : found->second;
    }

    /** Marks parameters that are written to, or handed on to functions that do. Returns whether it found more. */
    bool find_written() {
        bool is_changed = false;
        for (auto& [id, function] : m_functions) {
            for (std::size_t i = function.first; i < function.end; ++i) {
                for (const Id written : written_by(m_code[i])) {
                    const auto found = std::ranges::find(function.parameters, written);
                    if (found != function.parameters.end()) {
                        std::vector<bool>::reference mark = function.is_written[found - function.parameters.begin()];
                        is_changed = is_changed || !mark;
                        mark = true;
                    }
                }
            }
        }
        return is_changed;
    }

    std::vector<Id> written_by(const Instruction& instruction) const {
        std::vector<Id> written;
        if (instruction.is(spv::OpStore) || instruction.is(spv::OpCopyMemory)) {
            written.push_back(root(instruction.words[1]));
        } else if (instruction.is(spv::OpFunctionCall)) {
            const Function& callee = m_functions.at(instruction.words[3]);
            for (std::size_t j = 0; j < callee.parameters.size(); ++j) {
                if (callee.is_written[j]) {
                    written.push_back(root(instruction.words[call_words + j]));
                }
            }
        }
        return written;
    }

    void drop_in(const Function& function) {
        m_occurrences.clear();
        m_definitions.clear();
        for (std::size_t i = function.first; i < function.end; ++i) {
            const Instruction& instruction = m_code[i];
            for (std::size_t k = 1; k < instruction.words.size(); ++k) {
                ++m_occurrences[instruction.words[k]];
            }
            if (instruction.op == spv::OpVariable) {
                m_definitions[instruction.words[2]] = i;
            }
        }
        for (std::size_t i = function.first; i < function.end; ++i) {
            if (m_code[i].is(spv::OpFunctionCall)) {
                const Function& callee = m_functions.at(m_code[i].words[3]);
                for (std::size_t j = 0; j < callee.parameters.size(); ++j) {
                    drop_copy(i, call_words + j, callee.is_written[j]);
                }
            }
        }
    }

    /** The last instruction before `i`, in the same block, for which this holds. */
    template <class Condition> std::optional<std::size_t> before(std::size_t i, const Condition& holds) const {
        while (m_code[--i].op != spv::OpLabel) {
            if (!m_code[i].is_dropped && holds(m_code[i])) {
                return i;
            }
        }
        return {};
    }

    /** The first one behind `i` likewise. */
    template <class Condition> std::optional<std::size_t> behind(std::size_t i, const Condition& holds) const {
        while (m_code[++i].op != spv::OpLabel && m_code[i].op != spv::OpFunctionEnd) {
            if (!m_code[i].is_dropped && holds(m_code[i])) {
                return i;
            }
        }
        return {};
    }

    /** Of a variable: itself, or a pointer into it. A number that happens to be the same counts, too. */
    bool mentions(const Instruction& instruction, Id variable) const {
        return std::any_of(instruction.words.begin() + 1, instruction.words.end(),
                           [&](std::uint32_t word) { return root(word) == variable; });
    }

    bool writes(const Instruction& instruction, Id id) const {
        const std::vector<Id> written = written_by(instruction);
        return std::ranges::find(written, id) != written.end();
    }

    /** The copy that is argument `word` of a call, if the variable itself can be the argument. */
    void drop_copy(std::size_t call, std::size_t word, bool is_written) {
        const Id copy = m_code[call].words[word];
        // Its definition, the store before the call, the call, and the load behind it.
        if (!m_definitions.contains(copy) || m_occurrences[copy] != (is_written ? 4u : 3u)) {
            return;
        }
        const auto store = before(call, [&](const Instruction& i) { return i.op == spv::OpStore && i.words[1] == copy; });
        if (!store) {
            return;
        }
        const Id value = m_code[*store].words[2];
        const auto load = before(*store, [&](const Instruction& i) { return i.op == spv::OpLoad && i.words[2] == value; });
        if (!load) {
            return;
        }
        const Id variable = m_code[*load].words[3];
        const auto type = m_pointer_types.find(variable);
        if (type == m_pointer_types.end() || type->second != m_pointer_types.at(copy) || mentions(m_code[call], variable) ||
            before(call, [&](const Instruction& i) { return &i > &m_code[*load] && writes(i, variable); })) {
            return;
        }
        if (is_written && !drop_copy_back(call, copy, variable)) {
            return;
        }
        drop_instruction(*store);
        drop_instruction(m_definitions[copy]);
        m_dropped.insert(copy);
        if (m_occurrences[value] == 2) {
            drop_instruction(*load);
        }
        m_code[call].words[word] = variable;
    }

    /** Whether it is copied back into the variable, and nothing looks at that before. */
    bool drop_copy_back(std::size_t call, Id copy, Id variable) {
        const auto load = behind(call, [&](const Instruction& i) { return i.op == spv::OpLoad && i.words[3] == copy; });
        if (!load || m_occurrences[m_code[*load].words[2]] != 2) {
            return false;
        }
        const Id value = m_code[*load].words[2];
        const auto next = behind(call, [&](const Instruction& i) { return mentions(i, variable); });
        if (!next || m_code[*next].op != spv::OpStore || m_code[*next].words[1] != variable ||
            m_code[*next].words[2] != value) {
            return false;
        }
        drop_instruction(*load);
        drop_instruction(*next);
        return true;
    }

    void drop_instruction(std::size_t i) { m_code[i].is_dropped = true; }

    std::vector<Instruction> m_code;
    std::map<Id, Function> m_functions;
    /** While functions are noted. */
    Id m_current = 0;
    /** Of variables and parameters of functions. */
    std::map<Id, Id> m_pointer_types;
    std::map<Id, Id> m_roots;
    /** Of the function at hand: how often a word occurs, be it an id or a number; and where variables are declared. */
    std::map<std::uint32_t, std::uint32_t> m_occurrences;
    std::map<Id, std::size_t> m_definitions;
    std::set<Id> m_dropped;
};

} // namespace

std::vector<std::uint32_t> drop_argument_copies(std::span<const std::uint32_t> spirv) {
    std::vector<std::uint32_t> left(spirv.begin(), spirv.begin() + header_words);
    for (const Instruction& instruction : CopyDropper(spirv).drop()) {
        left.insert(left.end(), instruction.words.begin(), instruction.words.end());
    }
    return left;
}

} // namespace elvis
