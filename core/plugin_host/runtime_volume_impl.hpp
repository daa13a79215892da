/**
 * @file runtime_volume_impl.hpp
 * What a RuntimeVolume holds: the plugin, the opened volume, and what was read of it when it was opened.
 */
#pragma once

#include <core/base/error.hpp>
#include <core/plugin_host/host_services.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/plugin_host/table_copy.hpp>

namespace elvis {

struct RuntimeVolume::Impl {
    std::shared_ptr<const Plugin> plugin;
    const elvis_runtime* table = nullptr;
    std::unique_ptr<HostServices> services;
    std::string path;
    elvis_volume* volume = nullptr;
    bool is_closed_here = true;
    elvis_volume_info info{};
    std::vector<ClassInfo> classes;
    std::vector<FieldInfo> fields;
    std::vector<double> times;
    std::vector<std::string> groups;
    std::vector<std::pair<std::string, std::string>> notes;
    std::function<RuntimeVolume()> open_undeformed;
    std::optional<RuntimeVolume> undeformed;
    /** Of the fields behind the own ones: what finds them, and which one they are there. */
    std::vector<std::pair<std::shared_ptr<const FieldsByPlace>, std::uint32_t>> by_place;

    ~Impl() {
        if (volume && is_closed_here) {
            services->begin("close");
            table->close(volume);
            services->check(ELVIS_OK, "close", {});
        }
    }

    void check(elvis_result result, const char* function) const { services->check(result, function, path); }
    /** Throws Error for a field that is found by place. */
    void need_own(std::uint32_t field) const;
    /** Calls a function of the table by its name; throws what comes of it. */
    template <class Function, class... Arguments> void call(const char* name, Function function, Arguments... arguments) const {
        services->begin(name);
        check(function(volume, arguments...), name);
    }
    [[noreturn]] void refuse(const char* function, const std::string& what) const { services->refuse(function, path, what); }

    /** What this version cannot pass over: the picture would be wrong. */
    [[noreturn]] void refuse_newer(const std::string& what) const {
        throw Error(path,
                    "plugin " + plugin->id() + " needs a later version of ElVis: " + what + ", which this one does not know");
    }

    void check_certainty(elvis_certainty certainty, const char* function) const {
        if (certainty != ELVIS_CERTIFIED && certainty != ELVIS_ESTIMATED) {
            refuse(function, "the unknown certainty " + std::to_string(certainty));
        }
    }

    /** By one of the functions that bound derivatives. */
    elvis_certainty bound_derivatives(const char* name, decltype(elvis_runtime::get_field_derivative_bounds) function,
                                      std::uint32_t field, std::uint32_t time_step, std::uint64_t first, std::uint64_t count,
                                      std::span<DerivativeBounds> out) const;

    /** All that is fixed from open to close. */
    void read();
    void read_info();
    void read_classes();
    void read_fields();
    void read_texts();
};

} // namespace elvis
