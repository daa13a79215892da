#include "answers_as_json.hpp"
#include <apps/elvis/commands.hpp>
#include <apps/elvis/library_context.hpp>
#include <apps/elvis/number_list.hpp>
#include <apps/elvis/open_volume.hpp>
#include <apps/elvis/volume_arguments.hpp>

#include <core/base/error.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace elvis::commands {
namespace {

struct IntegrateArguments {
    VolumeArguments volume;
    std::string field;
    bool is_boundary = false;
    std::vector<std::string> groups;
    std::string plane;
    std::string isovalue;
    std::string level_field;
    bool is_flux = false;
    std::uint32_t time_step = 0;
    double tolerance = 0;
};

elvis_domain domain_of(const IntegrateArguments& arguments) {
    return arguments.is_boundary         ? ELVIS_DOMAIN_BOUNDARY
           : !arguments.plane.empty()    ? ELVIS_DOMAIN_PLANE
           : !arguments.isovalue.empty() ? ELVIS_DOMAIN_ISOSURFACE
                                         : ELVIS_DOMAIN_VOLUME;
}

/** Of an isosurface: what it is one of. */
std::string level_field_of(const IntegrateArguments& arguments) {
    if (arguments.isovalue.empty() || !arguments.level_field.empty()) {
        return arguments.level_field;
    }
    if (arguments.field.empty() || arguments.is_flux) {
        throw UsageError("--isosurface", "which field's? --isosurface-field says it");
    }
    return arguments.field;
}

elvis_integral integral_of(const data& volume, const IntegrateArguments& arguments) {
    const std::string level_field = level_field_of(arguments);
    const std::vector<elvis_string> groups = detail::c_strings(arguments.groups);
    auto wanted = detail::sized<elvis_integration>();
    wanted.domain = domain_of(arguments);
    wanted.field = detail::or_null(arguments.field);
    wanted.groups = groups.data();
    wanted.n_groups = static_cast<std::uint32_t>(groups.size());
    wanted.time_step = arguments.time_step;
    wanted.is_flux = arguments.is_flux ? 1 : 0;
    if (!arguments.plane.empty()) {
        std::ranges::copy(numbers("--cut-plane", arguments.plane, 4, 4), wanted.plane);
    }
    if (!arguments.isovalue.empty()) {
        wanted.level_field = level_field.c_str();
        wanted.isovalue = numbers("--isosurface", arguments.isovalue, 1, 1).front();
    }
    wanted.tolerance = arguments.tolerance;
    TaskControl control;
    const ProgressBar progress(control);
    const InterruptGuard guard(control);
    return volume.integrate(wanted, {[&](double fraction, const char* activity) { control.progress(fraction, activity); },
                                     [&] { return control.is_cancelled(); }});
}

void run_integrate(const IntegrateArguments& arguments) {
    const int n_domains = int{arguments.is_boundary} + int{!arguments.plane.empty()} + int{!arguments.isovalue.empty()};
    if (n_domains > 1) {
        throw UsageError("elvis integrate", "takes one of --boundary, --cut-plane and --isosurface");
    }
    if (arguments.is_flux && arguments.field.empty()) {
        throw UsageError("--flux", "needs --field, a vector");
    }
    const context library = library_context();
    const data volume = open_volume(library, arguments.volume, arguments.time_step);
    const elvis_integral integral = integral_of(volume, arguments);
    std::printf("%s\n", integral_json(integral).dump(2).c_str());
    for (const std::string& doubt : doubts_of(integral)) {
        std::fprintf(stderr, "warning: %s\n", doubt.c_str());
    }
}

} // namespace

void add_integrate(CLI::App& app) {
    auto arguments = std::make_shared<IntegrateArguments>();
    CLI::App* command =
        app.add_subcommand("integrate", "Print integrals over a volume, its boundary, planes or isosurfaces, and fluxes");
    add_volume_arguments(*command, arguments->volume);
    command->add_option("--field", arguments->field, "Field, component or expression to integrate; default: the number 1");
    command
        ->add_option("--boundary", arguments->groups,
                     "Over the whole boundary; with a name, over that group of it; may be repeated")
        ->expected(0, 1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command->add_option("--cut-plane", arguments->plane, "Over the plane a,b,c,d: ax+by+cz+d=0");
    command->add_option("--isosurface", arguments->isovalue, "Over the isosurface at this value");
    command->add_option("--isosurface-field", arguments->level_field,
                        "Field or expression of the isosurface; default: --field");
    command->add_flag(
        "--flux", arguments->is_flux,
        "The field is a vector, of which the component along the normal is integrated: out of the volume, along (a,b,c), or "
        "to where the isosurface's field is larger");
    command->add_option("--time-step", arguments->time_step, "Time step, counted from 0");
    command
        ->add_option("--tolerance", arguments->tolerance,
                     "Of the error, relative to the integral of the integrand's magnitude; default: 1e-9")
        ->check(CLI::Range(1e-14, 0.5));
    command->callback([arguments, command] {
        arguments->is_boundary = command->count("--boundary") > 0;
        // Without a name the list holds an empty one.
        std::erase_if(arguments->groups, [](const std::string& name) { return name.empty() || name == "{}"; });
        run_integrate(*arguments);
    });
}

} // namespace elvis::commands
