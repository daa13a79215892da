#include "arrays.hpp"

#include "array_mesh.hpp"
#include "call.hpp"

#include <core/base/counted.hpp>

#include <elvis/native/serve.hpp>
#include <elvis/plugin.hpp>

#include <cmath>

namespace elvis::library {

namespace {

/** Of the largest value of a Lagrange function: nodes that determine functions badly blow rounding up. */
constexpr double worst_condition = 1e10;

Eigen::PartialPivLU<Eigen::MatrixXd> from_nodes(const native::Space& space, const double* nodes, const std::string& what) {
    const auto n = static_cast<Eigen::Index>(native::n_modes(space));
    Eigen::MatrixXd values(n, n);
    std::vector<double> modes(static_cast<std::size_t>(n));
    for (Eigen::Index node = 0; node < n; ++node) {
        const native::Point xi{nodes[3 * node], nodes[3 * node + 1], nodes[3 * node + 2]};
        constexpr double tolerance = 1e-6; // Of nodes that were rounded.
        if (!(std::isfinite(xi[0]) && std::isfinite(xi[1]) && std::isfinite(xi[2])) ||
            !native::is_inside(space.shape, xi, tolerance)) {
            throw InvalidArgument(what, "node " + std::to_string(node) + " lies outside of the reference shape");
        }
        native::evaluate_modes(space, xi, modes);
        values.row(node) = Eigen::Map<const Eigen::RowVectorXd>(modes.data(), n);
    }
    Eigen::PartialPivLU<Eigen::MatrixXd> solver(values);
    if (!(solver.rcond() > 1 / worst_condition)) {
        throw InvalidArgument(what, "its nodes do not determine the functions of the space");
    }
    return solver;
}

/** The step's field of a class, as the caller has it. */
const double* values_of(const elvis_array_field& field, std::size_t place) {
    need(field.values, "values");
    need(field.values[place], "values");
    return field.values[place];
}

/** Dimension, times and groups. */
native::Description describe(const elvis_arrays& arrays) {
    native::Description description;
    description.dimension = static_cast<int>(arrays.dimension);
    if (arrays.times != nullptr) {
        description.times.assign(arrays.times, arrays.times + std::max(1u, arrays.n_time_steps));
    }
    for (std::uint32_t group = 0; group < arrays.n_boundary_groups; ++group) {
        need(arrays.boundary_groups, "boundary_groups");
        description.boundary_groups.push_back(text_or_empty(arrays.boundary_groups[group]));
    }
    return description;
}

/** Describes a class; returns its geometry's coefficients. */
std::vector<double> add_class(const elvis_array_class& given, std::uint32_t index, bool may_be_empty,
                              native::Description& description) {
    const std::string what = "class " + std::to_string(index);
    if (given.n_elements > 0) {
        need(given.geometry, what.c_str());
    } else if (!may_be_empty) {
        throw InvalidArgument(what, "has no elements");
    }
    const ToModes to_modes(known_part(given.geometry_space, what.c_str()), given.shape, what);
    description.classes.push_back({to_modes.space(), {}, given.n_elements});
    std::vector<double> coefficients(3 * to_modes.n_modes() * given.n_elements);
    to_modes.apply({given.geometry, coefficients.size()}, coefficients);
    return coefficients;
}

/** Describes a field; returns how its numbers become coefficients, by class. */
std::vector<ToModes> add_field(const elvis_array_field& given, std::uint32_t index, std::span<const elvis_array_class> classes,
                               native::Description& description) {
    const std::string what = "field " + std::to_string(index);
    need(given.name, what.c_str());
    need(given.spaces, what.c_str());
    if (given.continuity > ELVIS_CONTINUITY_DISCONTINUOUS || given.n_components == 0) {
        throw InvalidArgument(what, "its continuity is not known, or it has no components");
    }
    native::Field& own = description.fields.emplace_back();
    own.name = given.name;
    own.unit = text_or_empty(given.unit);
    own.n_components = given.n_components;
    own.continuity = static_cast<native::Continuity>(given.continuity);
    std::vector<ToModes> spaces;
    for (std::uint32_t of = 0; of < classes.size(); ++of) {
        spaces.emplace_back(copy_entry(given.spaces, of), classes[of].shape, what + " in class " + std::to_string(of));
        description.classes[of].fields.push_back(spaces.back().space());
    }
    return spaces;
}

void check_counts(const elvis_arrays& arrays) {
    if (arrays.dimension != 2 && arrays.dimension != 3) {
        throw InvalidArgument("arrays", "the dimension is neither 2 nor 3");
    }
    if (arrays.n_classes == 0 || arrays.n_fields == 0) {
        throw InvalidArgument("arrays", "there is no class, or no field");
    }
    need(arrays.classes, "classes");
    need(arrays.fields, "fields");
    if (arrays.n_time_steps > 1) {
        need(arrays.times, "times");
    }
}

} // namespace

ToModes::ToModes(const elvis_space& space, elvis_shape shape, const std::string& what) {
    if (shape > ELVIS_SHAPE_TRIANGLE || space.basis > ELVIS_BASIS_TENSOR) {
        throw InvalidArgument(what, "its shape or basis is not known");
    }
    m_space = {static_cast<native::Shape>(shape),
               static_cast<native::Basis>(space.basis),
               {space.order[0], space.order[1], space.order[2]}};
    try {
        native::check(m_space);
    } catch (const std::invalid_argument& reason) {
        throw InvalidArgument(what, reason.what());
    }
    m_n_modes = native::n_modes(m_space);
    if (space.nodes != nullptr) {
        m_from_nodes = from_nodes(m_space, space.nodes, what);
    }
}

void ToModes::apply(std::span<const double> numbers, std::span<double> coefficients) const {
    if (!m_from_nodes) {
        std::ranges::copy(numbers, coefficients.begin());
        return;
    }
    const auto n = static_cast<Eigen::Index>(m_n_modes);
    const auto n_rows = static_cast<Eigen::Index>(numbers.size()) / n;
    Eigen::Map<Eigen::MatrixXd>(coefficients.data(), n, n_rows) =
        m_from_nodes->solve(Eigen::Map<const Eigen::MatrixXd>(numbers.data(), n, n_rows));
}

ArrayContents::ArrayContents(const elvis_arrays& arrays, bool may_be_empty) {
    check_counts(arrays);
    description = describe(arrays);
    for (std::uint32_t index = 0; index < arrays.n_classes; ++index) {
        classes.push_back(copy_entry(arrays.classes, index));
        geometry.push_back(add_class(classes.back(), index, may_be_empty, description));
    }
    for (std::uint32_t index = 0; index < arrays.n_fields; ++index) {
        fields.push_back(copy_entry(arrays.fields, index));
        to_modes.push_back(add_field(fields.back(), index, classes, description));
    }
}

Arrays::Arrays(const elvis_arrays& arrays, const std::string& name, const TaskControl& control) {
    ArrayContents contents(arrays);
    native::Description& description = contents.description;
    std::vector<native::Face> faces = faces_of_mesh(description, contents.geometry, contents.classes, name, control);
    description.n_faces = faces.size();
    m_fields = std::move(contents.to_modes);
    m_volume = std::make_shared<native::ArrayVolume>(std::move(description), std::move(faces));
    for (std::uint32_t index = 0; index < arrays.n_classes; ++index) {
        std::ranges::copy(contents.geometry[index], m_volume->geometry(index).begin());
    }
    for (std::uint32_t field = 0; field < arrays.n_fields; ++field) {
        for (std::uint32_t step = 0; step < m_volume->description().times.size(); ++step) {
            for (std::uint32_t index = 0; index < arrays.n_classes; ++index) {
                control.check();
                update(field, step, index, values_of(contents.fields[field], step * std::size_t{arrays.n_classes} + index));
            }
        }
    }
}

RuntimeVolume Arrays::open(const std::string& name, const TaskControl* control) {
    const auto serve = [&](const elvis_host* host) {
        try {
            m_served = native::serve(host, name, m_volume);
        } catch (const api::Error& failure) {
            throw InvalidArgument(name, failure.what());
        }
        return m_served;
    };
    return {Plugin::of_native(name), name, serve, control};
}

void Arrays::update(std::uint32_t field, std::uint32_t time_step, std::uint32_t element_class, const double* values) {
    const native::Description& description = m_volume->description();
    if (field >= description.fields.size() || time_step >= description.times.size() ||
        element_class >= description.classes.size()) {
        throw InvalidArgument("field", "there are " + counted(description.fields.size(), "field") + ", " +
                                           counted(description.times.size(), "time step") + " and " +
                                           std::to_string(description.classes.size()) + " classes of elements");
    }
    need(values, "values");
    const std::span<double> own = m_volume->field(field, time_step, element_class);
    m_fields[field][element_class].apply({values, own.size()}, own);
    if (m_served != nullptr) {
        native::forget_fields(m_served);
    }
}

} // namespace elvis::library
