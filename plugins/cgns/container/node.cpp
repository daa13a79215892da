#include "node.hpp"

#include <elvis/plugin.hpp>

namespace elvis_cgns {

std::uint64_t Node::size() const {
    constexpr std::uint64_t most = std::uint64_t{1} << 60;
    std::uint64_t size = shape.empty() ? 0 : 1;
    for (const std::uint64_t extent : shape) {
        if (extent != 0 && size > most / extent) {
            fail("has more numbers than a file can hold");
        }
        size *= extent;
    }
    return size;
}

bool Node::holds_integers() const { return type == "I4" || type == "I8" || type == "U4" || type == "U8"; }

bool Node::holds_numbers() const { return holds_integers() || type == "R4" || type == "R8"; }

void Node::fail(const std::string& what) const {
    throw elvis::api::Error(ELVIS_ERROR_FORMAT, container ? container->path() : std::string(),
                            (path.empty() ? "the root" : path) + " " + what);
}

} // namespace elvis_cgns
