#include "linear_elements.hpp"

#include <plugins/nodal/linear_element.hpp>

#include <cmath>

namespace elvis_pyfr {

namespace {

constexpr std::uint64_t element_block = 4096;

} // namespace

std::vector<bool> find_linear_elements(const Mesh& mesh, const elvis::api::Host& host) {
    std::vector<bool> linear(mesh.n_elements());
    for (const ElementSet& set : mesh.sets()) {
        const elvis::nodal::LinearElement is_linear(*set.nodes, set.corners);
        const std::size_t n_numbers = 3 * set.nodes->size();
        for (std::uint64_t first = 0; first < set.count; first += element_block) {
            host.check_cancelled();
            const std::uint64_t count = std::min(element_block, set.count - first);
            const std::vector<double> positions = mesh.read_nodes(set, first, count);
            for (std::uint64_t element = 0; element < count; ++element) {
                const std::span own(&positions[n_numbers * element], n_numbers);
                if (!std::ranges::all_of(own, [](double number) { return std::isfinite(number); })) {
                    throw elvis::api::Error(ELVIS_ERROR_FORMAT, mesh.path(),
                                            "element " + std::to_string(first + element) + " of the " +
                                                std::string(set.kind->name) + " has a node that is not finite");
                }
                linear[set.first + first + element] = is_linear(own.data());
            }
        }
    }
    return linear;
}

} // namespace elvis_pyfr
