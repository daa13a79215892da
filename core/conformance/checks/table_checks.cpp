/**
 * @file table_checks.cpp
 * Checks that a plugin honours the sizes of structs: members of later versions, strides of arrays.
 */
#include <core/conformance/check.hpp>
#include <core/conformance/test_host.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace elvis::conformance {

namespace {

constexpr unsigned char filler = 0xab;

/** A struct of a later version, with members at its end that the plugin cannot know. */
template <class Struct> struct Later {
    Struct known{};
    unsigned char later[16];

    Later() {
        known.struct_size = sizeof(Later);
        std::memset(later, filler, sizeof later);
    }
    bool is_sound() const {
        return known.struct_size == sizeof(Later) &&
               std::all_of(std::begin(later), std::end(later), [](unsigned char byte) { return byte == filler; });
    }
};

template <class Struct, class Call> void check_struct(Context& context, const char* function, Call&& call) {
    context.progress(std::string(function) + " with the struct of a later version");
    Later<Struct> out;
    const elvis_result result = call(&out.known);
    if (result != ELVIS_OK) {
        context.fail(std::string(function) + " with the larger struct of a later version returned " + result_name(result));
    } else if (!out.is_sound()) {
        context.fail(std::string(function) +
                     " overwrites struct_size or members of a later version; write only what struct_size covers and you know");
    }
}

/** `same` compares what two calls wrote. */
template <class Struct, class Call, class Same>
void check_array(Context& context, const char* function, std::size_t count, Call&& call, Same&& same) {
    context.progress(std::string(function) + " with structs of a later version");
    std::vector<Struct> expected(count);
    std::vector<Later<Struct>> larger(count);
    for (Struct& entry : expected) {
        entry.struct_size = sizeof entry;
    }
    if (call(expected.data()) != ELVIS_OK || call(&larger[0].known) != ELVIS_OK) {
        context.fail(std::string(function) + " fails");
        return;
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (!larger[i].is_sound() || !same(expected[i], larger[i].known)) {
            context.fail(std::string(function) + ": entry " + std::to_string(i) +
                         " is wrong where structs are larger; the stride of an array is struct_size of its first entry");
            return;
        }
    }
}

void check_runtime_structs(Context& context) {
    context.need_runtime_volume();
    const elvis_runtime& table = *context.plugin()->runtime();
    TestHost host;
    const std::string& options = context.subject().options;
    const Opening opening(*context.plugin(), Interface::runtime, host, context.subject().files,
                          options.empty() ? nullptr : options.c_str());
    if (!opening.is_open()) {
        context.fail(std::string("open returned ") + result_name(opening.result()) + ": " + host.take_error());
        return;
    }
    elvis_volume* volume = opening.volume();
    elvis_volume_info info{};
    info.struct_size = sizeof info;
    table.get_info(volume, &info);
    check_struct<elvis_volume_info>(context, "get_info", [&](auto* out) { return table.get_info(volume, out); });
    check_struct<elvis_element_class>(context, "get_class", [&](auto* out) { return table.get_class(volume, 0, out); });
    check_struct<elvis_snippet>(context, "get_snippet", [&](auto* out) { return table.get_snippet(volume, 0, out); });
    if (info.n_fields > 0) {
        check_struct<elvis_field>(context, "get_field", [&](auto* out) { return table.get_field(volume, 0, out); });
        check_struct<elvis_class_field>(context, "get_class_field",
                                        [&](auto* out) { return table.get_class_field(volume, 0, 0, out); });
    }
    if (info.n_buffers > 0) {
        check_struct<elvis_buffer>(context, "get_buffer", [&](auto* out) { return table.get_buffer(volume, 0, 0, out); });
    }
    if (table.get_faces && info.n_faces > 0) {
        const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(info.n_faces, 100));
        check_array<elvis_face>(
            context, "get_faces", count, [&](auto* out) { return table.get_faces(volume, 0, count, out); },
            [](const elvis_face& a, const elvis_face& b) {
                return a.group == b.group && a.element == b.element && a.neighbour == b.neighbour &&
                       a.local_face == b.local_face && a.neighbour_local_face == b.neighbour_local_face;
            });
    }
    if (table.check_jacobians && info.n_elements > 0 && info.dimension == 3) {
        const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(info.n_elements, 100));
        elvis_certainty certainty = ELVIS_ESTIMATED;
        check_array<elvis_jacobian_check>(
            context, "check_jacobians", count,
            [&](auto* out) { return table.check_jacobians(volume, 0, count, 1e-6, out, &certainty); },
            [](const elvis_jacobian_check& a, const elvis_jacobian_check& b) { return a.sign == b.sign; });
    }
}

void check_source_structs(Context& context) {
    context.need_source();
    const elvis_converter& table = *context.plugin()->converter();
    TestHost host;
    const std::string& options = context.subject().options;
    const Opening opening(*context.plugin(), Interface::converter, host, context.subject().files,
                          options.empty() ? nullptr : options.c_str());
    if (!opening.is_open()) {
        context.fail(std::string("open returned ") + result_name(opening.result()) + ": " + host.take_error());
        return;
    }
    elvis_source_volume* source = opening.source();
    elvis_source_info info{};
    info.struct_size = sizeof info;
    table.get_info(source, &info);
    check_struct<elvis_source_info>(context, "get_info", [&](auto* out) { return table.get_info(source, out); });
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(info.n_elements, 100));
    if (info.n_fields > 0) {
        check_struct<elvis_source_field>(context, "get_field", [&](auto* out) { return table.get_field(source, 0, out); });
        check_array<elvis_source_space>(
            context, "get_spaces", count, [&](auto* out) { return table.get_spaces(source, 0, 0, count, out); },
            [](const elvis_source_space& a, const elvis_source_space& b) {
                return std::equal(a.order, a.order + 3, b.order) && a.is_contained == b.is_contained;
            });
    }
    check_array<elvis_source_element>(
        context, "get_elements", count, [&](auto* out) { return table.get_elements(source, 0, count, out); },
        [](const elvis_source_element& a, const elvis_source_element& b) {
            return a.shape == b.shape && std::equal(a.geometry_order, a.geometry_order + 3, b.geometry_order) &&
                   std::equal(a.corners, a.corners + 3, b.corners) &&
                   std::equal(a.face_groups, a.face_groups + 4, b.face_groups);
        });
}

} // namespace

std::vector<Check> table_checks() {
    return {
        {"struct-sizes", "functions of the runtime interface honour the struct sizes of a later host", check_runtime_structs},
        {"source-struct-sizes", "functions of the converter interface honour the struct sizes of a later host",
         check_source_structs},
    };
}

} // namespace elvis::conformance
