/*
 * Every kernel compiles, up to SPIR-V, for every shape in single precision, as the program asks for it, and for one shape of
 * each kind in double precision, whose text differs in names of types and numbers alone. Drivers are not asked, but SPIR-V is
 * evaluated as far as is known, and valid. Snippets that
 * give the least go with one shape of each kind, too, in single precision.
 *
 * Left out is what makes no difference to the text: numbers of classes, sizes of groups and tiles, degrees of polynomials and
 * more than one kind of fetch (tests/shader/fetch_test.cpp has all); expressions and the elements' own boundary, which know no
 * shape, go with one shape of each dimension and one snippet.
 */
#include "fixture.hpp"
#include "kernel_table.hpp"
#include "spirv.hpp"

#include <core/base/error.hpp>
#include <core/expression/glsl.hpp>
#include <core/shader/compiler.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <set>

using namespace elvis;
using test::Element;
using test::KernelUse;

namespace {

using Defines = std::vector<std::pair<std::string, std::string>>;

struct NamedShape {
    elvis_shape shape;
    const char* name;
    bool is_flat, is_of_each_kind;
};
constexpr std::array<NamedShape, 6> shapes{NamedShape{ELVIS_SHAPE_HEXAHEDRON, "hexahedron", false, true},
                                           NamedShape{ELVIS_SHAPE_PRISM, "prism", false, false},
                                           NamedShape{ELVIS_SHAPE_PYRAMID, "pyramid", false, true},
                                           NamedShape{ELVIS_SHAPE_TETRAHEDRON, "tetrahedron", false, false},
                                           NamedShape{ELVIS_SHAPE_QUADRILATERAL, "quadrilateral", true, true},
                                           NamedShape{ELVIS_SHAPE_TRIANGLE, "triangle", true, false}};

/** What a snippet must give, or all that it can. */
enum class Gives { least, all };

Snippet snippet_that_gives(Gives gives) {
    Snippet snippet = test::simple_snippet();
    if (gives == Gives::all) {
        snippet.capabilities = ELVIS_SNIPPET_FIELD_GRADIENT | ELVIS_SNIPPET_MAPPING_JACOBIAN | ELVIS_SNIPPET_FIELD_HESSIAN |
                               ELVIS_SNIPPET_MAPPING_HESSIAN | ELVIS_SNIPPET_INSIDE;
        snippet.sources.front().text +=
            "void elvis_field_gradient(uint element, elvis_vec3 xi, uint component, out elvis_real value,\n"
            "                          out elvis_vec3 gradient) {\n"
            "    value = elvis_field_value(element, xi, component);\n"
            "    gradient = elvis_vec3(2, 0, 0);\n"
            "}\n"
            "void elvis_mapping_jacobian(uint element, elvis_vec3 xi, out elvis_vec3 x, out elvis_mat3 jacobian) {\n"
            "    x = elvis_mapping(element, xi);\n"
            "    jacobian = elvis_jacobian(element, xi);\n"
            "}\n"
            "void elvis_field_hessian(uint element, elvis_vec3 xi, uint component, out elvis_real value,\n"
            "                         out elvis_vec3 gradient, out elvis_mat3 hessian) {\n"
            "    elvis_field_gradient(element, xi, component, value, gradient);\n"
            "    hessian = elvis_mat3(0);\n"
            "}\n"
            "void elvis_mapping_hessian(uint element, elvis_vec3 xi, out elvis_vec3 x, out elvis_mat3 jacobian,\n"
            "                           out elvis_mat3 hessian_x, out elvis_mat3 hessian_y, out elvis_mat3 hessian_z) {\n"
            "    elvis_mapping_jacobian(element, xi, x, jacobian);\n"
            "    hessian_x = hessian_y = hessian_z = elvis_mat3(0);\n"
            "}\n"
            "void elvis_inside(uint element, elvis_vec3 xi, out elvis_real g, out elvis_vec3 gradient) {\n"
            "    g = xi.x;\n"
            "    gradient = elvis_vec3(1, 0, 0);\n"
            "}\n"
            "elvis_vec2 elvis_inside_bounds(uint element) { return elvis_vec2(1, 0); }\n";
    }
    return snippet;
}

/** The host's record buffers: of each only its kind and size stand in a kernel's text. */
class HostBuffers {
public:
    explicit HostBuffers(Precision precision)
        : m_reals(m_device, RecordKind::real, precision, 1, 48), m_uints(m_device, RecordKind::uint, precision, 1, 48) {}

    const Device& device() const { return m_device; }

    FetchBuffer buffer(const std::string& name) const {
        const std::string kind = " (reals)";
        if (const std::size_t at = name.find(kind); at != std::string::npos) {
            return {name.substr(0, at), &m_reals};
        }
        static const std::set<std::string> of_reals{"core_bounds", "core_bounds_1", "core_curvatures", "core_face_points",
                                                    "core_triangles"};
        return {name, of_reals.count(name) != 0 ? &m_reals : &m_uints};
    }

private:
    Device m_device;
    RecordBuffer m_reals, m_uints;
};

/** What a kernel shows: the field itself, an expression, or the elements' own boundary. */
struct Shown {
    std::string name;
    std::string expression;
};
const std::string own_boundary = "own boundary";

std::vector<Shown> all_shown(const KernelUse& use, const NamedShape& shape, Gives gives) {
    // Of fields alone, and of gradients: the models of the former are certain, those of the latter estimates.
    const std::vector<Shown> expressions{{"expression", "u * p + element"},
                                         {"expression of gradients", "norm(grad(p)) + u[0]"}};
    const bool is_first =
        gives == Gives::all && (shape.shape == ELVIS_SHAPE_HEXAHEDRON || shape.shape == ELVIS_SHAPE_QUADRILATERAL);
    const bool is_expression = use.element == Element::expression_gradient || use.element == Element::expression_error;
    std::vector<Shown> shown;
    if (!is_expression) {
        shown.push_back({"field", ""});
    }
    if (is_expression || (is_first && (use.element == Element::value || use.element == Element::model))) {
        shown.insert(shown.end(), expressions.begin(), expressions.end());
    }
    if (is_first && use.shows_own_boundary) {
        shown.push_back({own_boundary, ""});
    }
    return shown;
}

/** Every combination of the choices. */
std::vector<Defines> combinations(const std::vector<test::Choice>& choices) {
    std::vector<Defines> all{{}};
    for (const test::Choice& choice : choices) {
        std::vector<Defines> longer;
        for (const Defines& defines : all) {
            for (const std::string& value : choice.values) {
                longer.push_back(defines);
                longer.back().emplace_back(choice.name, value);
            }
        }
        all = std::move(longer);
    }
    return all;
}

/** As DeviceVolume::add_field and the kernels of probes and ranges have it. */
void add_element(KernelRequest& request, const KernelUse& use, const NamedShape& shape, Gives gives, const Shown& shown,
                 const HostBuffers& buffers) {
    SnippetInstance instance;
    instance.snippet = snippet_that_gives(gives);
    instance.shape = shape.shape;
    instance.n_components = 3;
    const bool is_expression = !shown.expression.empty();
    request.instances.assign(is_expression ? 2 : use.n_instances, instance);
    if (use.element == Element::model) {
        request.buffers.push_back(buffers.buffer("core_bounds"));
        request.buffers.push_back(buffers.buffer("core_curvatures"));
    }
    if (shown.name == own_boundary) {
        request.text += "#include \"field/own_boundary.glsl\"\n";
    }
    if (!is_expression) {
        return;
    }
    const std::uint32_t dimension = shape.is_flat ? 2 : 3;
    const std::vector<FieldInfo> fields{{"u", "", 3}, {"p", "", 1}};
    const Expression expression(shown.expression, fields, dimension);
    const ExpressionClass about{.dimension = dimension, .capabilities = instance.snippet.capabilities, .orders = {3, 3}};
    request.instances[1].n_components = 1;
    request.with_second_derivatives = use.with_second_derivatives || expression.needs_second_derivatives() ||
                                      (use.element == Element::model && expression.gradient_needs_second_derivatives());
    if (use.element == Element::model) {
        request.buffers.push_back(buffers.buffer("core_bounds_1"));
    }
    const auto is_elements = [](const FetchBuffer& buffer) { return buffer.name == "core_elements"; };
    if (std::none_of(request.buffers.begin(), request.buffers.end(), is_elements)) {
        request.buffers.push_back(buffers.buffer("core_elements"));
    }
    request.text += use.element == Element::expression_error ? error_glsl(expression, about) : value_glsl(expression, about);
    if (use.element == Element::expression_gradient) {
        request.text += gradient_glsl(expression, about);
    }
    if (use.element == Element::model) {
        request.text += model_glsl(expression, about);
    }
}

KernelRequest request_for(const KernelUse& use, const Defines& defines, Precision precision, const HostBuffers& buffers) {
    KernelRequest request;
    request.name = use.kernel;
    request.kernel = use.kernel + ".comp";
    if (!use.includes.empty()) {
        request.kernel_text = use.includes + "#include \"" + request.kernel + "\"\n";
    }
    request.precision = precision;
    request.defines = defines;
    request.with_second_derivatives = use.with_second_derivatives;
    request.watches_loops = use.watches_loops;
    request.is_debug_build = use.is_debug_build;
    for (const std::string& name : use.buffers) {
        request.buffers.push_back(buffers.buffer(name));
    }
    // As many as any kernel has, and more: record buffers come behind them.
    for (std::uint32_t binding = 0; binding < 12; ++binding) {
        request.bindings.push_back({binding, BindingType::storage_buffer});
    }
    return request;
}

/** Says what it is that does not compile. */
void check_compiles(KernelRequest request, const std::string& of_element, const Device& device) {
    request.name += (of_element.empty() ? "" : ", ") + of_element;
    request.name += request.precision == Precision::float64 ? ", float64" : ", float32";
    for (const auto& [name, value] : request.defines) {
        request.name += " " + name + "=" + value;
    }
    try {
        const std::vector<std::uint32_t> spirv = compile_shader(compose_text(device, request), request.name);
        INFO(request.name);
        // A kernel that has calls was left as it was (core/spirv/partial_evaluation.hpp).
        CHECK(test::count_of(spirv, spv::OpFunctionCall) == 0);
        // Which takes longer than all the rest: of a few.
        static std::size_t n_checked = 0;
        CHECK((n_checked++ % 16 != 0 || test::is_valid(spirv)));
    } catch (const Error& error) {
        FAIL_CHECK(error.what());
    }
}

void check_use(const KernelUse& use, const HostBuffers& buffers, Precision precision, bool is_exhaustive) {
    if (use.is_double_only && precision != Precision::float64) {
        return;
    }
    for (const Defines& defines : combinations(use.choices)) {
        const KernelRequest plain = request_for(use, defines, precision, buffers);
        if (use.element == Element::none) {
            KernelRequest request = plain;
            request.text = use.text;
            check_compiles(request, "", buffers.device());
            continue;
        }
        for (const NamedShape& shape : shapes) {
            if ((shape.is_flat && use.is_for_solids) ||
                (precision == Precision::float64 && !shape.is_of_each_kind && !is_exhaustive)) {
                continue;
            }
            for (const Gives gives : {Gives::least, Gives::all}) {
                if (gives == Gives::least && !is_exhaustive && (precision == Precision::float64 || !shape.is_of_each_kind)) {
                    continue;
                }
                for (const Shown& shown : all_shown(use, shape, gives)) {
                    KernelRequest request = plain;
                    add_element(request, use, shape, gives, shown, buffers);
                    request.text += use.text;
                    check_compiles(request,
                                   std::string(shape.name) + ", " + shown.name + ", snippet with " +
                                       (gives == Gives::all ? "all functions" : "required functions"),
                                   buffers.device());
                }
            }
        }
    }
}

} // namespace

TEST_CASE("The table of kernels has every file and no other") {
    std::set<std::string> files, listed;
    for (const auto& file : std::filesystem::recursive_directory_iterator(ELVIS_SHADERS)) {
        if (file.path().extension() == ".comp") {
            files.insert(file.path().lexically_relative(ELVIS_SHADERS).replace_extension().string());
        }
    }
    for (const KernelUse& use : test::kernel_uses()) {
        listed.insert(use.kernel);
    }
    for (const std::string& file : files) {
        INFO("shaders/" << file
                        << ".comp is not in tests/shader/kernel_table.cpp: it is compiled for no shape, in no precision");
        CHECK(listed.count(file) == 1);
    }
    for (const std::string& kernel : listed) {
        INFO("tests/shader/kernel_table.cpp has '" << kernel << "', of which there is no file in shaders");
        CHECK(files.count(kernel) == 1);
    }
}

namespace {

void check_all(Precision precision, bool is_exhaustive) {
    const test::CacheFolder cache;
    const HostBuffers buffers(precision);
    for (const KernelUse& use : test::kernel_uses()) {
        check_use(use, buffers, precision, is_exhaustive);
    }
}

} // namespace

TEST_CASE("Every kernel compiles for every shape in single precision") { check_all(Precision::float32, false); }

TEST_CASE("Every kernel compiles for shapes of each kind in double precision") { check_all(Precision::float64, false); }

TEST_CASE("Every kernel compiles with every snippet for every shape in both precisions", "[.long]") {
    check_all(Precision::float32, true);
    check_all(Precision::float64, true);
}
