#include <core/convert/projection/packed_blocks.hpp>

#include <cassert>
#include <cstring>
#include <type_traits>

namespace elvis {

namespace {

class Packer {
public:
    template <class T> void put(std::span<const T> items) {
        static_assert(std::is_trivially_copyable_v<T>);
        const std::uint64_t n = items.size();
        append(std::as_bytes(std::span(&n, 1)));
        append(std::as_bytes(items));
    }
    void put(const std::vector<std::vector<double>>& lists) {
        const std::uint64_t n = lists.size();
        append(std::as_bytes(std::span(&n, 1)));
        for (const std::vector<double>& list : lists) {
            put(std::span(list));
        }
    }
    std::vector<std::byte> take() { return std::move(m_bytes); }

private:
    void append(std::span<const std::byte> bytes) { m_bytes.insert(m_bytes.end(), bytes.begin(), bytes.end()); }
    std::vector<std::byte> m_bytes;
};

class Unpacker {
public:
    explicit Unpacker(std::span<const std::byte> bytes) : m_left(bytes) {}
    bool is_done() const { return m_left.empty(); }
    template <class T> std::vector<T> items() {
        std::vector<T> all(count());
        assert(m_left.size() >= all.size() * sizeof(T));
        if (!all.empty()) {
            std::memcpy(all.data(), m_left.data(), all.size() * sizeof(T));
        }
        m_left = m_left.subspan(all.size() * sizeof(T));
        return all;
    }
    std::vector<std::vector<double>> lists() {
        std::vector<std::vector<double>> all(count());
        for (std::vector<double>& list : all) {
            list = items<double>();
        }
        return all;
    }

private:
    std::uint64_t count() {
        assert(m_left.size() >= sizeof(std::uint64_t));
        std::uint64_t n = 0;
        std::memcpy(&n, m_left.data(), sizeof n);
        m_left = m_left.subspan(sizeof n);
        return n;
    }
    std::span<const std::byte> m_left;
};

struct BlockFacts {
    std::uint64_t first, count;
    double largest_distance;
};

} // namespace

std::vector<std::byte> packed(std::span<const BlockResult> blocks) {
    Packer packer;
    for (const BlockResult& block : blocks) {
        const BlockFacts facts{block.first, block.count, block.largest_distance};
        packer.put(std::span(&facts, 1));
        packer.put(std::span(block.geometry));
        packer.put(block.fields);
        packer.put(block.at_faces);
        packer.put(std::span(block.measures));
    }
    return packer.take();
}

std::vector<BlockResult> unpacked_blocks(std::span<const std::byte> bytes) {
    std::vector<BlockResult> blocks;
    for (Unpacker unpacker(bytes); !unpacker.is_done();) {
        const BlockFacts facts = unpacker.items<BlockFacts>().front();
        BlockResult& block = blocks.emplace_back();
        block.first = facts.first;
        block.count = facts.count;
        block.largest_distance = facts.largest_distance;
        block.geometry = unpacker.items<double>();
        block.fields = unpacker.lists();
        block.at_faces = unpacker.lists();
        block.measures = unpacker.items<FieldMeasure>();
    }
    return blocks;
}

} // namespace elvis
