#include "mesh.hpp"
#include "text.hpp"

#include <elvis/plugin.hpp>

#include <stdexcept>

namespace elvis_mfem {

GridFunction read_grid_function(Text& text) {
    GridFunction result;
    // MFEM writes the longer form for spaces that the short one cannot describe.
    const bool is_long = text.accept("MFEM");
    text.expect("FiniteElementSpace");
    if (is_long) {
        text.expect("v1.0");
    }
    text.expect("FiniteElementCollection:");
    const std::string_view name = text.word("the name of a finite element collection");
    try {
        if (name.starts_with("NURBS")) {
            result.nurbs_order = parse_nurbs_order(name);
        } else {
            result.collection = parse_collection(name);
        }
    } catch (const std::invalid_argument& error) {
        text.fail(error.what());
    }
    text.expect("VDim:");
    result.n_components = static_cast<int>(text.integer("the number of components", 1, 1024));
    if (result.collection.is_vector() && result.n_components > 1) {
        text.fail("several copies of a Nedelec or Raviart-Thomas field in one file are not supported");
    }
    text.expect("Ordering:");
    result.is_interleaved = text.integer("the ordering", 0, 1) == 1;
    if (is_long) {
        if (text.peek() != "End:") {
            text.fail(shown(text.peek()) + " is not supported: orders that vary over the mesh or its directions are not");
        }
        text.expect("End:");
        text.expect("MFEM");
        text.expect("FiniteElementSpace");
        text.expect("v1.0");
    }
    while (text.is_number_next()) {
        result.values.push_back(text.real("a value"));
    }
    return result;
}

GridFunction read_solution(const std::string& path, int* digits) {
    Text text(path);
    if (text.peek() == "solution") {
        text.fail("this file holds a mesh besides the solution; it is read alone");
    }
    GridFunction result = read_grid_function(text);
    if (!text.at_end()) {
        text.word("a value");
        text.fail("a value should be a number");
    }
    *digits = text.max_digits();
    return result;
}

} // namespace elvis_mfem
