/*
 * The functions of elvis/insitu.h.
 */
#include "run.hpp"

#include <core/api/call.hpp>

struct elvis_insitu {
    std::shared_ptr<elvis::library::Context> context;
    std::unique_ptr<elvis::library::InsituRun> run;
};

/** Beside the handle, where calls look for it. */
static elvis::library::Context* context_of(const elvis_insitu* handle) {
    return handle != nullptr ? handle->context.get() : nullptr;
}

using namespace elvis;
using namespace elvis::library;

elvis_result elvis_insitu_open(elvis_context* context, const elvis_communicator* communicator, const elvis_arrays* arrays,
                               elvis_string plan, elvis_string folder, elvis_insitu** insitu) {
    return call(context, [&] {
        need(insitu, "insitu");
        *insitu = nullptr;
        need(plan, "plan");
        auto run = std::make_unique<InsituRun>(context->state, communicator, known_part(arrays, "arrays"), plan,
                                               folder != nullptr ? folder : ".");
        *insitu = new elvis_insitu{context->state, std::move(run)};
    });
}

elvis_result elvis_insitu_open_runtime(elvis_context* context, const elvis_communicator* communicator,
                                       const elvis_runtime* runtime, elvis_volume* volume, const uint8_t* is_own,
                                       elvis_string plan, elvis_string folder, elvis_insitu** insitu) {
    return call(context, [&] {
        need(insitu, "insitu");
        *insitu = nullptr;
        need(plan, "plan");
        auto run = std::make_unique<InsituRun>(context->state, communicator, known_part(runtime, "runtime"), volume, is_own,
                                               plan, folder != nullptr ? folder : ".");
        *insitu = new elvis_insitu{context->state, std::move(run)};
    });
}

elvis_result elvis_insitu_set_values(elvis_insitu* insitu, uint32_t field, uint32_t element_class, const double* values) {
    return call(insitu, [&] { insitu->run->set_values(field, element_class, values); });
}

elvis_result elvis_insitu_step(elvis_insitu* insitu, uint64_t step, double time) {
    return call(insitu, [&] { insitu->run->step(step, time); });
}

elvis_result elvis_insitu_get_report(const elvis_insitu* insitu, elvis_insitu_report* report) {
    return call(insitu, [&] { give(insitu->run->report(), report, "report"); });
}

elvis_string elvis_insitu_error(const elvis_insitu* insitu) { return error_of(context_of(insitu)); }

void elvis_insitu_release(elvis_insitu* insitu) { delete insitu; }
