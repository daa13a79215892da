#include <core/spirv/dead_code.hpp>

#include <algorithm>
#include <span>

namespace elvis {

namespace {

/** Whether it does nothing but give its result. */
bool is_expression(spv::Op op) {
    return (op >= spv::OpConvertFToU && op <= spv::OpFwidthCoarse) ||
           (op >= spv::OpVectorExtractDynamic && op <= spv::OpTranspose) || op == spv::OpExtInst || op == spv::OpLoad ||
           op == spv::OpAccessChain || op == spv::OpUndef || op == spv::OpPhi || op == spv::OpImageFetch ||
           op == spv::OpVariable || op == spv::OpCopyLogical || op == spv::OpArrayLength;
}

class LiveCode {
public:
    LiveCode(std::vector<SpirvInstruction>& body, const SpirvValues& values)
        : m_body(body), m_values(values), m_is_live(body.size()) {
        for (std::size_t i = 0; i < body.size(); ++i) {
            if (body[i].result >= m_definitions.size()) {
                m_definitions.resize(2 * body[i].result + 1, nowhere);
            }
            m_definitions[body[i].result] = body[i].result != 0 ? i : nowhere;
        }
        for (std::size_t i = 0; i < body.size(); ++i) {
            const SpirvId root = body[i].op == spv::OpStore ? root_of(body[i].words[1]) : 0;
            if (is_local(root)) {
                m_stores[root].push_back(i);
            } else if (!is_expression(body[i].op)) {
                mark(i);
            }
        }
    }

    void keep() {
        while (!m_left.empty()) {
            const SpirvInstruction& instruction = m_body[m_left.back()];
            m_left.pop_back();
            for (const std::uint16_t k : instruction.operands) {
                mark_definition(instruction.words[k]);
                if (instruction.op != spv::OpAccessChain && instruction.op != spv::OpStore) {
                    mark_stores(instruction.words[k]);
                }
            }
        }
        std::size_t i = 0;
        std::erase_if(m_body, [&](const SpirvInstruction&) { return !m_is_live[i++]; });
    }

private:
    static constexpr std::size_t nowhere = static_cast<std::size_t>(-1);

    /** 0 of what is defined elsewhere, as constants and variables of the module are. */
    const SpirvInstruction* definition(SpirvId id) const {
        const std::size_t at = id < m_definitions.size() ? m_definitions[id] : nowhere;
        return at == nowhere ? nullptr : &m_body[at];
    }

    SpirvId root_of(SpirvId pointer) const {
        const SpirvInstruction* chain = definition(pointer);
        return chain && chain->op == spv::OpAccessChain ? chain->words[3] : pointer;
    }

    bool is_local(SpirvId id) const { return definition(id) && definition(id)->op == spv::OpVariable; }

    void mark(std::size_t i) {
        if (!m_is_live[i]) {
            m_is_live[i] = true;
            m_left.push_back(i);
        }
    }

    void mark_definition(SpirvId id) {
        if (const SpirvInstruction* instruction = definition(id)) {
            mark(static_cast<std::size_t>(instruction - m_body.data()));
        }
    }

    /** Those that may change what a pointer points to. */
    void mark_stores(SpirvId pointer) {
        const auto found = m_stores.find(root_of(pointer));
        if (found == m_stores.end()) {
            return;
        }
        std::erase_if(found->second, [&](std::size_t store) {
            const bool is_used = overlap(m_body[store].words[1], pointer);
            if (is_used) {
                mark(store);
            }
            return is_used;
        });
    }

    /** Of pointers into one variable: they do unless they are known to differ in an index. */
    bool overlap(SpirvId a, SpirvId b) const {
        const std::span<const SpirvId> first = indices(a), second = indices(b);
        for (std::size_t k = 0; k < std::min(first.size(), second.size()); ++k) {
            const auto number = m_values.number(first[k]), other = m_values.number(second[k]);
            if (number && other && *number != *other) {
                return false;
            }
        }
        return true;
    }

    std::span<const SpirvId> indices(SpirvId pointer) const {
        const SpirvInstruction* chain = definition(pointer);
        return chain->op == spv::OpAccessChain ? std::span(chain->words).subspan(4) : std::span<const SpirvId>();
    }

    std::vector<SpirvInstruction>& m_body;
    const SpirvValues& m_values;
    std::vector<bool> m_is_live;
    /** By id: where it is the result. */
    std::vector<std::size_t> m_definitions;
    /** By local variable, until they are known to be live. */
    std::map<SpirvId, std::vector<std::size_t>> m_stores;
    /** Live ones whose operands have not been looked at. */
    std::vector<std::size_t> m_left;
};

} // namespace

void drop_dead_code(std::vector<SpirvInstruction>& body, const SpirvValues& values) { LiveCode(body, values).keep(); }

} // namespace elvis
