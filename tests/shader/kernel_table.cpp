#include "kernel_table.hpp"

#include <core/expression/glsl.hpp>
#include <core/segment/tables.hpp>

namespace elvis::test {

namespace {

const Choice pixel_group{"CORE_GROUP_SIZE", {"256u"}};
const Choice width{"CORE_TILE_WIDTH", {"8u"}};
const Choice height{"CORE_TILE_HEIGHT", {"16u"}};
const Choice group_width{"CORE_GROUP_WIDTH", {"4u"}};
const Choice element_class{"CORE_CLASS", {"3u"}};
const Choice no_or_yes(const char* name) { return {name, {"0", "1"}}; }
const Choice yes(const char* name) { return {name, {"1"}}; }
const Choice no(const char* name) { return {name, {"0"}}; }

const std::vector<std::string> elements{"core_nodes", "core_elements"};
const std::vector<std::string> bent_elements{"core_nodes", "core_elements", "core_reaches"};
const std::vector<std::string> faces{"core_nodes", "core_faces", "core_patches"};
const std::vector<std::string> fitted_faces{"core_nodes", "core_faces", "core_patches", "core_face_points"};
const std::vector<std::string> octants{"core_elements", "core_nodes", "core_octants"};
const std::vector<std::string> chains{"core_nodes", "core_links", "core_elements"};
const std::string bends = "core_bends (reals)", forms = "core_bend_forms (reals)";
const std::vector<std::string> curved_chains{"core_nodes", "core_links", "core_cones", "core_elements", bends};

/** For elements that are nearly linear, and for strongly bent ones. */
void add_for_bends(std::vector<KernelUse>& uses, KernelUse use) {
    use.choices.push_back(no("CORE_STRONGLY_BENT"));
    uses.push_back(use);
    use.choices.back() = yes("CORE_STRONGLY_BENT");
    use.buffers.push_back(bends);
    uses.push_back(use);
}

void add_pixel_kernels(std::vector<KernelUse>& uses) {
    for (const char* kernel :
         {"picture/background", "picture/blend", "picture/condition", "picture/lic", "picture/lic_component",
          "picture/lic_directions", "picture/lic_owners", "picture/line_stretches", "picture/merge", "picture/occlude",
          "picture/order_layers", "picture/screen", "picture/take_layer", "volume/volume_begin", "volume/volume_finish",
          "volume/volume_runs", "volume/volume_transparency"}) {
        uses.push_back({.kernel = kernel, .choices = {pixel_group}});
    }
    uses.push_back({.kernel = "isosurface/list_open_pixels", .choices = {pixel_group, no_or_yes("CORE_FILLS_MASK")}});
    uses.push_back({.kernel = "picture/settle_flags", .choices = {pixel_group, {"CORE_PIXELS_EACH", {"8u"}}}});
    uses.push_back({.kernel = "picture/color",
                    .choices = {pixel_group, no_or_yes("CORE_IS_LIT"), no_or_yes("CORE_HAS_LINES"),
                                no_or_yes("CORE_HAS_WIDE_LINES"), no_or_yes("CORE_IS_CLIPPED"), no_or_yes("CORE_IS_SHADED")}});
    uses.push_back({.kernel = "picture/list_pixels", .choices = {pixel_group, width, height}});
    uses.push_back({.kernel = "volume/live_rays", .choices = {width, height, group_width, {"CORE_GROUPS", {"16u"}}}});
    uses.push_back({.kernel = "cut_surface/surface_outside", .choices = {pixel_group, no_or_yes("CORE_ON_PLANE")}});
}

void add_element_kernels(std::vector<KernelUse>& uses) {
    uses.push_back({.kernel = "field/derivative_bounds", .element = Element::snippet, .watches_loops = true});
    uses.push_back({.kernel = "boundary/edge_samples", .element = Element::snippet});
    uses.push_back(
        {.kernel = "segments/face_cones", .element = Element::snippet, .is_for_solids = true, .watches_loops = true});
    uses.push_back({.kernel = "boundary/face_samples", .element = Element::snippet, .buffers = {"core_faces"}});
    uses.push_back({.kernel = "element/linearize",
                    .element = Element::snippet,
                    .choices = {no_or_yes("CORE_IS_MEASURED")},
                    .watches_loops = true});
    uses.push_back({.kernel = "field/sampled_range", .element = Element::value, .buffers = elements, .watches_loops = true});
    uses.push_back(
        {.kernel = "field/point_values", .element = Element::value, .choices = {{"CORE_GROUP_SIZE", {"64"}}, element_class}});
    uses.push_back({.kernel = "probe/probe_invert", .element = Element::snippet, .is_double_only = true});
    uses.push_back({.kernel = "probe/probe_evaluate", .element = Element::snippet, .is_double_only = true});
    uses.push_back({.kernel = "probe/probe_expression",
                    .element = Element::expression_gradient,
                    .is_double_only = true,
                    .with_second_derivatives = true});
    uses.push_back(
        {.kernel = "field/expression_error", .element = Element::expression_error, .buffers = elements, .watches_loops = true});
}

void add_cut_kernels(std::vector<KernelUse>& uses) {
    uses.push_back({.kernel = "cut_surface/other_values", .element = Element::value, .choices = {{"CORE_GROUP_SIZE", {"64"}}}});
    const Choice group{"CORE_GROUP_SIZE", {"32"}};
    uses.push_back({.kernel = "cut_surface/element_octants",
                    .element = Element::snippet,
                    .buffers = {"core_curvatures"},
                    .choices = {group},
                    .is_for_solids = true,
                    .watches_loops = true});
    uses.push_back({.kernel = "cut_surface/element_reaches",
                    .element = Element::snippet,
                    .buffers = {"core_elements"},
                    .is_for_solids = true,
                    .watches_loops = true});
    uses.push_back({.kernel = "cut_surface/sift_points",
                    .element = Element::snippet,
                    .buffers = {"core_nodes", "core_elements", "core_reaches", "core_octants", "core_octant_nodes"},
                    .choices = {group, no_or_yes("CORE_ON_PLANE")},
                    .is_for_solids = true});
    uses.push_back({.kernel = "cut_surface/open_points",
                    .element = Element::value,
                    .buffers = {"core_nodes", "core_elements", "core_reaches", "core_octants", "core_octant_nodes"},
                    .choices = {group, element_class, no_or_yes("CORE_ON_PLANE")},
                    .is_for_solids = true});
    uses.push_back({.kernel = "cut_surface/cut_tiles", .buffers = elements, .choices = {width, height}});
    uses.push_back({.kernel = "cut_surface/cut_plane",
                    .element = Element::value,
                    .buffers = bent_elements,
                    .choices = {width, height, no("CORE_LINES"), no_or_yes("CORE_OVERLAPS")},
                    .is_for_solids = true});
    add_for_bends(uses, {.kernel = "cut_surface/cut_plane",
                         .element = Element::model,
                         .buffers = elements,
                         .choices = {width, height, yes("CORE_LINES"), no_or_yes("CORE_OVERLAPS")},
                         .is_for_solids = true});
    add_for_bends(uses, {.kernel = "lines/cut_lines",
                         .element = Element::model,
                         .buffers = elements,
                         .choices = {width, height, yes("CORE_LINES")},
                         .is_for_solids = true});
    uses.push_back({.kernel = "cut_surface/surface_tiles", .buffers = elements, .choices = {width, height}});
    uses.push_back({.kernel = "cut_surface/surface_pixels",
                    .element = Element::value,
                    .buffers = bent_elements,
                    .choices = {width, height, no_or_yes("CORE_OVERLAPS"), element_class},
                    .is_for_solids = true});
    const std::vector<Choice> hits{width, height, {"CORE_HIT_ROWS", {"4u"}}, {"CORE_SHAPE_ROWS", {"8"}}};
    const auto add_surface = [&](const char* file, std::vector<std::string> buffers, const Choice& ends, std::string text) {
        KernelUse use{.kernel = "surface/hits", .buffers = std::move(buffers), .choices = hits, .text = std::move(text)};
        use.choices.push_back(ends);
        use.includes = std::string("#include \"surface/") + file + ".glsl\"\n";
        uses.push_back(use);
    };
    add_surface("quadric", {}, no_or_yes("CORE_HAS_ENDS"), "");
    add_surface("torus", {}, no("CORE_HAS_ENDS"), "");
    add_surface("mesh", {"core_triangles", "core_nodes"}, no("CORE_HAS_ENDS"), "");
    add_surface("bezier", {"core_patches (reals)", "core_nodes"}, no("CORE_HAS_ENDS"), "");
    add_surface("tubes", {"core_tubes (reals)", "core_nodes"}, no("CORE_HAS_ENDS"), "");
    add_surface("ribbons", {"core_ribbons (reals)", "core_nodes"}, no("CORE_HAS_ENDS"), "");
    add_surface("arrows", {"core_arrows (reals)", "core_arrow_numbers", "core_nodes"}, no("CORE_HAS_ENDS"), "");
    add_surface("implicit", {}, no("CORE_HAS_ENDS"), implicit_glsl(Expression::implicit("sin(x) + max(y, z^2)")));
}

void add_face_kernels(std::vector<KernelUse>& uses) {
    uses.push_back(
        {.kernel = "tiles/ray_tiles", .buffers = {"core_nodes"}, .choices = {width, height, yes("CORE_LISTS_TILES")}});
    for (const bool is_polynomial : {false, true}) {
        for (const char* kernel : {"boundary/faces", "boundary/faces_careful"}) {
            KernelUse use{.kernel = kernel,
                          .element = Element::value,
                          .buffers = fitted_faces,
                          .choices = {width, height, yes("CORE_LISTS_TILES"), element_class}};
            use.choices.push_back(use.kernel == "boundary/faces" ? no_or_yes("CORE_DESCENDS") : yes("CORE_DESCENDS"));
            if (is_polynomial) {
                use.choices.push_back({"CORE_FACE_ORDER", {"3"}});
            }
            uses.push_back(use);
        }
    }
}

void add_line_kernels(std::vector<KernelUse>& uses) {
    for (const char* kernel : {"lines/settle_lines", "lines/surface_lines", "lines/face_lines_careful"}) {
        add_for_bends(uses, {.kernel = kernel,
                             .element = Element::model,
                             .buffers = faces,
                             .choices = {width, height, yes("CORE_ON_FACES"), no_or_yes("CORE_WITH_CONTOURS")}});
    }
    const std::vector<Choice> on_surface{width, height, no("CORE_ON_FACES"), no_or_yes("CORE_WITH_CONTOURS")};
    add_for_bends(uses, {.kernel = "lines/settle_lines",
                         .element = Element::model,
                         .buffers = elements,
                         .choices = on_surface,
                         .is_for_solids = true,
                         .shows_own_boundary = true});
    // Quadrics have rows, and segments of rays; other surfaces neither.
    for (const bool is_quadric : {false, true}) {
        KernelUse lines{.kernel = "lines/surface_lines",
                        .element = Element::model,
                        .buffers = elements,
                        .choices = on_surface,
                        .is_for_solids = true,
                        .shows_own_boundary = true};
        lines.choices.insert(lines.choices.end(),
                             {{"CORE_FEW_SUBDIVISIONS", {"2u"}},
                              is_quadric ? no_or_yes("CORE_BY_QUADRIC_SPANS") : no("CORE_BY_QUADRIC_SPANS"),
                              no("CORE_HAS_ENDS"),
                              {"CORE_SHAPE_ROWS", {is_quadric ? "8" : "0"}}});
        add_for_bends(uses, lines);
    }
}

void add_isosurface_kernels(std::vector<KernelUse>& uses) {
    for (const char* kernel : {"field/linear_models", "isosurface/octants"}) {
        uses.push_back({.kernel = kernel,
                        .element = Element::model,
                        .is_for_solids = true,
                        .shows_own_boundary = true,
                        .watches_loops = true});
    }
    uses.push_back({.kernel = "isosurface/octants",
                    .element = Element::model,
                    .buffers = {forms},
                    .is_for_solids = true,
                    .watches_loops = true});
    const std::vector<Choice> common{
        width, height, {"CORE_ROWS", {"4u"}}, {"CORE_TILE_CAPACITY", {"512u"}}, yes("CORE_TESTS_ISOVALUES"), element_class};
    const auto use = [&](const char* kernel, const std::vector<std::string>& buffers, const std::vector<Choice>& more) {
        KernelUse made{.kernel = kernel, .element = Element::model, .buffers = buffers, .choices = common};
        made.choices.insert(made.choices.end(), more.begin(), more.end());
        made.is_for_solids = made.shows_own_boundary = true;
        return made;
    };
    uses.push_back(use("tiles/ray_tiles", octants, {no_or_yes("CORE_HAS_ONE_ISOVALUE"), yes("CORE_LISTS_TILES")}));
    uses.push_back(use("isosurface/isosurface", octants,
                       {no_or_yes("CORE_HAS_ONE_ISOVALUE"), no_or_yes("CORE_DESCENDS"), no("CORE_HAS_MASK")}));
    uses.push_back(use("isosurface/isosurface", octants,
                       {no_or_yes("CORE_HAS_ONE_ISOVALUE"), yes("CORE_DESCENDS"), yes("CORE_HAS_MASK")}));
    std::vector<std::string> with_forms = octants;
    with_forms.push_back(forms);
    uses.push_back(use("isosurface/isosurface", with_forms,
                       {no_or_yes("CORE_HAS_ONE_ISOVALUE"), no_or_yes("CORE_DESCENDS"), no("CORE_HAS_MASK")}));
    for (const bool is_nested : {true, false}) {
        KernelUse projection = use("isosurface/isosurface_projection", {"core_elements", "core_nodes", "core_models"},
                                   {no_or_yes("CORE_USES_COLLEAGUE"), is_nested ? no("CORE_PLAIN") : yes("CORE_PLAIN")});
        projection.text = segment::segment_glsl(is_nested ? segment::nested_plan() : segment::fixed_plan(6));
        uses.push_back(projection);
    }
}

void add_ray_kernels(std::vector<KernelUse>& uses) {
    for (const bool is_curved : {false, true}) {
        const std::vector<std::string>& buffers = is_curved ? curved_chains : chains;
        const std::vector<Choice> common{width,
                                         height,
                                         group_width,
                                         {"CORE_LEAF_WORD", {"index"}},
                                         is_curved ? yes("CORE_HAS_CURVED") : no("CORE_HAS_CURVED")};
        const auto use = [&](const char* kernel, Element element, const std::vector<Choice>& more) {
            KernelUse made{.kernel = kernel, .element = element, .buffers = buffers, .choices = common};
            made.choices.insert(made.choices.end(), more.begin(), more.end());
            made.is_for_solids = true;
            return made;
        };
        const std::vector<Choice> for_segments{yes("CORE_MAKES_SEGMENTS"), no_or_yes("CORE_RAYS_ARE_GIVEN")};
        uses.push_back(use("tiles/ray_tiles", Element::snippet, {yes("CORE_TESTS_STARTS")}));
        uses.push_back(use("segments/find_walk", Element::snippet, {}));
        uses.push_back(use("segments/find_walk", Element::snippet, for_segments));
        uses.push_back(use("segments/start_at_eye", Element::snippet, {}));
        uses.push_back(use("segments/start_at_eye", Element::snippet, for_segments));
        uses.push_back(use("segments/segments", Element::snippet, for_segments));
        KernelUse march = use("volume/volume_march", Element::model,
                              {{"CORE_INTEGRATOR", {"0", "1", "2", "3", "4"}},
                               no_or_yes("CORE_HAS_JUMPS"),
                               {"CORE_FIRST_LEVEL", {"2u"}},
                               {"CORE_FIELD_DEGREE", {"6"}}});
        march.buffers.emplace_back("core_models");
        march.text = segment::segment_glsl(segment::fixed_plan(5));
        uses.push_back(march);
    }
}

void add_checks(std::vector<KernelUse>& uses) {
    uses.push_back({.kernel = "bench/bench_roots",
                    .choices = {no_or_yes("CORE_COLLEAGUE")},
                    .text = segment::segment_glsl(segment::fixed_plan(8))});
    uses.push_back({.kernel = "bench/bench_unit", .element = Element::snippet});
    uses.push_back(
        {.kernel = "conformance/compose_check", .element = Element::snippet, .buffers = {"counts"}, .n_instances = 2});
    uses.push_back({.kernel = "conformance/conformance", .element = Element::snippet});
    uses.push_back({.kernel = "conformance/conformance", .element = Element::snippet, .with_second_derivatives = true});
    uses.push_back({.kernel = "conformance/conformance",
                    .element = Element::snippet,
                    .with_second_derivatives = true,
                    .is_debug_build = true});
    uses.push_back({.kernel = "conformance/hessian_check", .element = Element::snippet, .with_second_derivatives = true});
    uses.push_back({.kernel = "conformance/snippet_check", .element = Element::snippet});
}

} // namespace

std::vector<KernelUse> kernel_uses() {
    std::vector<KernelUse> uses;
    add_pixel_kernels(uses);
    add_element_kernels(uses);
    add_cut_kernels(uses);
    add_face_kernels(uses);
    add_line_kernels(uses);
    add_isosurface_kernels(uses);
    add_ray_kernels(uses);
    add_checks(uses);
    return uses;
}

} // namespace elvis::test
