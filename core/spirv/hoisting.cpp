#include <core/spirv/hoisting.hpp>

#include <algorithm>
#include <limits>

namespace elvis {

namespace {

/** Of one loop: more numbers than these would not stay near the processor. */
constexpr std::size_t most_fetches = 256;
constexpr std::size_t elsewhere = std::numeric_limits<std::size_t>::max();

/** Whether it may be computed where its result is not wanted, and gives the same everywhere. */
bool is_place(spv::Op op) {
    switch (op) {
    case spv::OpIAdd:
    case spv::OpISub:
    case spv::OpIMul:
    case spv::OpBitcast:
    case spv::OpBitwiseAnd:
    case spv::OpBitwiseOr:
    case spv::OpBitwiseXor:
    case spv::OpShiftLeftLogical:
    case spv::OpShiftRightLogical:
    case spv::OpCompositeExtract:
    case spv::OpCompositeConstruct:
    case spv::OpImageFetch:
        return true;
    default:
        return false;
    }
}

/** A loop's instructions: from its header's label to before the label behind it. */
struct LoopRange {
    std::size_t first, end;
    std::size_t n_fetches = 0;
};

class Hoisting {
public:
    explicit Hoisting(std::vector<SpirvInstruction>& body) : m_body(body), m_moved_before(body.size(), elsewhere) {
        for (std::size_t i = 0; i < body.size(); ++i) {
            note(body[i].result, i);
        }
        for (std::size_t i = 0; i < body.size(); ++i) {
            if (body[i].op == spv::OpLoopMerge) {
                add_loop(i);
            }
        }
    }

    void hoist() {
        for (std::size_t i = 0; i < m_body.size(); ++i) {
            if (m_body[i].op == spv::OpImageFetch) {
                hoist(i);
            }
        }
        write();
    }

private:
    void note(SpirvId id, std::size_t at) {
        if (id >= m_definitions.size()) {
            m_definitions.resize(2 * std::size_t{id} + 1, elsewhere);
        }
        m_definitions[id] = id != 0 ? at : elsewhere;
    }

    std::size_t definition(SpirvId id) const { return id < m_definitions.size() ? m_definitions[id] : elsewhere; }

    /** The block with the merge instruction is the header. One that nothing but a branch leads to can take what is moved. */
    void add_loop(std::size_t merge) {
        std::size_t first = merge;
        while (m_body[first].op != spv::OpLabel) {
            --first;
        }
        if (first > 0 && m_body[first - 1].op == spv::OpBranch && m_body[first - 1].words[1] == m_body[first].result) {
            m_loops.push_back({first, definition(m_body[merge].words[1])});
        }
    }

    /** Whether a value is known before the loop, wherever it is computed. `is_image`: it is an image, which is always the same.
     */
    bool is_known_before(const LoopRange& loop, SpirvId id, bool is_image = false) const {
        const std::size_t at = definition(id);
        if (at == elsewhere || at < loop.first || at >= loop.end || m_moved_before[at] <= loop.first) {
            return true;
        }
        const SpirvInstruction& i = m_body[at];
        if (is_image && i.op == spv::OpLoad) {
            return definition(i.words[3]) == elsewhere;
        }
        return is_place(i.op) && std::ranges::all_of(i.operands, [&](std::uint16_t k) {
                   return is_known_before(loop, i.words[k], i.op == spv::OpImageFetch && k == 3);
               });
    }

    void hoist(std::size_t fetch) {
        for (LoopRange& loop : m_loops) {
            const bool is_inside = fetch > loop.first && fetch < loop.end;
            if (is_inside && loop.n_fetches < most_fetches && is_known_before(loop, m_body[fetch].result)) {
                loop.n_fetches += 1;
                move_before(loop, m_body[fetch].result);
                return;
            }
        }
    }

    void move_before(const LoopRange& loop, SpirvId id) {
        const std::size_t at = definition(id);
        if (at != elsewhere && at >= loop.first && at < loop.end && m_moved_before[at] > loop.first) {
            m_moved_before[at] = loop.first;
            for (const std::uint16_t k : m_body[at].operands) {
                move_before(loop, m_body[at].words[k]);
            }
        }
    }

    /** What is moved stands before the branch to its loop, in the order in which it stood. */
    void write() {
        std::vector<std::vector<std::size_t>> moved(m_body.size());
        for (std::size_t i = 0; i < m_body.size(); ++i) {
            if (m_moved_before[i] != elsewhere) {
                moved[m_moved_before[i] - 1].push_back(i);
            }
        }
        std::vector<SpirvInstruction> written;
        written.reserve(m_body.size());
        for (std::size_t i = 0; i < m_body.size(); ++i) {
            for (const std::size_t k : moved[i]) {
                written.push_back(std::move(m_body[k]));
            }
            if (m_moved_before[i] == elsewhere) {
                written.push_back(std::move(m_body[i]));
            }
        }
        m_body = std::move(written);
    }

    std::vector<SpirvInstruction>& m_body;
    /** By id: where it is the result. */
    std::vector<std::size_t> m_definitions;
    /** By instruction: the loop's beginning. */
    std::vector<std::size_t> m_moved_before;
    /** Outer ones come first. */
    std::vector<LoopRange> m_loops;
};

} // namespace

void hoist_fetches(std::vector<SpirvInstruction>& body) { Hoisting(body).hoist(); }

} // namespace elvis
