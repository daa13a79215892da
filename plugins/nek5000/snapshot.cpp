#include "snapshot.hpp"

#include "file_name.hpp"
#include "old_snapshot.hpp"
#include "part_snapshot.hpp"

namespace elvis_nek5000 {

Snapshot::Snapshot(std::string path, Content content, std::uint32_t n_parts)
    : m_path(std::move(path)), m_content(std::move(content)), m_n_parts(n_parts), m_is_regular(is_regular(m_path, n_parts)) {}

NodeSet Snapshot::nodes(std::size_t block) const {
    NodeSet set{m_content.n_nodes, m_is_regular ? NodeFamily::equidistant : NodeFamily::gauss_lobatto};
    if (m_content.has_gauss_pressure && m_content.blocks[block].quantity == Quantity::pressure) {
        set.family = NodeFamily::gauss;
        for (std::uint32_t direction = 0; direction < m_content.dimension(); ++direction) {
            set.n[direction] -= 2;
        }
    }
    return set;
}

std::uint32_t probe_snapshot(const ByteFile& file) { return is_part(file) ? 100 : probe_old_file(file); }

std::unique_ptr<Snapshot> open_snapshot(const std::string& path, OpenFiles& files) {
    if (is_part(*files.open(path))) {
        return std::make_unique<PartSnapshot>(path, files);
    }
    return std::make_unique<OldSnapshot>(path, files);
}

} // namespace elvis_nek5000
