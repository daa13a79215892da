/*
 * A runtime plugin with the C++ wrapper: one cube, without any buffer.
 */
#include "outside_snippet.hpp"

#include <elvis/plugin.hpp>

namespace {

class Cube : public elvis::api::RuntimeVolume {
public:
    static std::uint32_t probe(const char*) { return 1; }
    Cube(const elvis::api::Host& host, const std::string&, const std::string&) : RuntimeVolume(host) {}

    void get_info(elvis_volume_info& info) override {
        info.dimension = 3;
        info.n_elements = info.n_classes = info.n_fields = info.n_time_steps = 1;
    }
    void get_class(std::uint32_t, elvis_element_class& out) override {
        out.shape = ELVIS_SHAPE_HEXAHEDRON;
        out.n_elements = 1;
    }
    void get_field(std::uint32_t, elvis_field& out) override {
        out.name = "x";
        out.n_components = 1;
    }
    void get_class_field(std::uint32_t, std::uint32_t, elvis_class_field&) override {}
    double get_time(std::uint32_t) override { return 0; }
    void get_buffer(std::uint32_t, std::uint32_t, elvis_buffer&) override {}
    void get_snippet(std::uint32_t, elvis_snippet& out) override {
        static const elvis_text source = elvis::api::text("outside.glsl", outside::snippet::files[0].text);
        out.prefix = "outside";
        out.n_sources = 1;
        out.sources = &source;
    }
    elvis_certainty get_bounds(std::uint64_t, std::uint64_t, std::span<double> bounds) override {
        for (std::size_t i = 0; i < bounds.size(); ++i) {
            bounds[i] = i % 6 < 3 ? -1 : 1;
        }
        return ELVIS_CERTIFIED;
    }
    void fill_buffer(const elvis_fill_request&, void*) override {}
};

} // namespace

ELVIS_PLUGIN(.id = "org.example.outside", .name = "Outside", .version = "1.0.0", .runtime = elvis::api::runtime_table<Cube>());
