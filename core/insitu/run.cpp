#include "run.hpp"
#include "rank_table_volume.hpp"
#include "rank_volume.hpp"
#include "table_volume.hpp"

#include <core/api/call.hpp>
#include <core/api/drawing.hpp>
#include <core/base/counted.hpp>
#include <core/base/csv_text.hpp>
#include <core/base/log.hpp>
#include <core/base/milliseconds.hpp>
#include <core/base/peak_memory.hpp>
#include <core/scene/output/buffers_file.hpp>
#include <core/scene/output/png_file.hpp>
#include <core/vulkan/device_choice.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <utility>

namespace elvis::library {

namespace {

/** What the volume is called in messages. */
constexpr const char* volume_name = "solver";

double seconds_since(std::chrono::steady_clock::time_point start) { return 1e-3 * milliseconds_since(start); }

/** Of a machine's devices the one of the rank's place on it, unless one is named. */
void choose_device_of(std::uint32_t local_rank, Context& context) {
    if (context.wanted_device.empty() && !environment_variable("ELVIS_DEVICE")) {
        if (const std::vector<std::string> devices = named_devices("all"); devices.size() > 1) {
            context.wanted_device = devices[local_rank % devices.size()];
        }
    }
}

/** Where a solver has no other ranks to talk to. */
const elvis_communicator one_rank = [] {
    elvis_communicator table{};
    table.struct_size = sizeof table;
    table.size = 1;
    table.minimum = [](void*, double*, std::uint64_t) -> std::int32_t { return 0; };
    table.broadcast = [](void*, std::uint32_t, void*, std::uint64_t) -> std::int32_t { return 0; };
    table.exchange = [](void*, const elvis_message*, std::uint32_t, const elvis_message*, std::uint32_t) -> std::int32_t {
        return 0;
    };
    return table;
}();

std::string numbered(const std::string& name, std::uint64_t step, const char* ending) {
    char number[32];
    std::snprintf(number, sizeof number, "_%06llu", static_cast<unsigned long long>(step));
    return name + number + ending;
}

} // namespace

InsituRun::InsituRun(std::shared_ptr<Context> context, const elvis_communicator* communicator, const elvis_arrays& arrays,
                     const std::string& plan, std::string folder)
    : m_context(std::move(context)), m_team(communicator), m_folder(std::move(folder)) {
    const auto start = std::chrono::steady_clock::now();
    m_team.together([&] {
        m_volume = std::make_unique<RankVolume>(arrays, volume_name, m_team, m_control);
        open_plan(plan);
    });
    m_opened = std::chrono::steady_clock::now();
    m_report.open_seconds = seconds_since(start);
}

InsituRun::InsituRun(std::shared_ptr<Context> context, const elvis_communicator* communicator, const elvis_runtime& table,
                     elvis_volume* volume, const std::uint8_t* is_own, const std::string& plan, std::string folder)
    : m_context(std::move(context)), m_team(communicator != nullptr ? communicator : &one_rank), m_folder(std::move(folder)) {
    const auto start = std::chrono::steady_clock::now();
    m_team.together([&] { open_table(table, volume, is_own, plan); });
    m_opened = std::chrono::steady_clock::now();
    m_report.open_seconds = seconds_since(start);
}

void InsituRun::open_table(const elvis_runtime& table, elvis_volume* volume, const std::uint8_t* is_own,
                           const std::string& plan) {
    if (m_team.size() > 1) {
        m_volume = std::make_unique<RankTableVolume>(table, volume, is_own, volume_name, m_team);
    } else {
        m_volume = std::make_unique<TableVolume>(table, volume, volume_name);
        const std::uint64_t n_elements = m_volume->whole().n_elements();
        if (is_own != nullptr && std::any_of(is_own, is_own + n_elements, [](std::uint8_t own) { return own == 0; })) {
            throw InvalidArgument("is_own", "the only rank has elements that are not its own");
        }
    }
    open_plan(plan);
}

void InsituRun::open_plan(const std::string& plan) {
    choose_device_of(m_team.local_rank(), *m_context);
    m_reductions.emplace(*m_volume, m_team, m_control, [this]() -> const Device& { return m_context->device(); });
    const std::vector<double> first = m_team.of_first({plan.begin(), plan.end()});
    if (plan != std::string(first.begin(), first.end())) {
        throw InvalidArgument("plan", "is not that of rank 0");
    }
    if (m_team.is_first() && !m_folder.empty()) {
        std::error_code failure;
        if (std::filesystem::create_directories(m_folder, failure); failure) {
            throw Error(m_folder, "cannot be made: " + failure.message());
        }
    }
    for (PlannedOutput& planned : read_plan(plan, m_folder, m_volume->whole())) {
        add(std::move(planned));
    }
}

void InsituRun::add(PlannedOutput planned) {
    m_outputs.push_back(std::make_unique<Output>());
    Output& output = *m_outputs.back();
    output.planned = std::move(planned);
    const std::string table = path(output.planned.name + ".csv");
    if (const auto* const samples = std::get_if<PlannedSamples>(&output.planned.what)) {
        output.samples = std::make_unique<Samples>(*samples, table, *m_volume, m_team);
    } else if (const auto* const numbers = std::get_if<PlannedNumbers>(&output.planned.what); numbers && m_team.is_first()) {
        std::vector<std::string> columns{"step", "time"};
        for (const Quantity& quantity : numbers->quantities) {
            columns.push_back(quantity.text());
        }
        output.numbers.emplace(table, columns);
    }
}

std::string InsituRun::path(const std::string& name) const { return (std::filesystem::path(m_folder) / name).string(); }

void InsituRun::set_values(std::uint32_t field, std::uint32_t element_class, const double* values) {
    m_volume->set_values(field, element_class, values);
}

void InsituRun::check_order(std::uint64_t step, double time) const {
    if (!std::isfinite(time) || (m_last_step && (step < *m_last_step || time < *m_last_time))) {
        throw InvalidArgument("step " + std::to_string(step), "comes after a later one, or its time is before that of one");
    }
}

void InsituRun::step(std::uint64_t step, double time) {
    const auto start = std::chrono::steady_clock::now();
    const std::uint64_t sent_before = m_team.sent_bytes();
    m_report.n_outputs = 0;
    m_report.read_bytes = 0;
    m_team.together([&] { make(step, time); });
    m_last_step = step;
    m_last_time = time;
    m_report.sent_bytes = m_team.sent_bytes() - sent_before;
    m_report.step_seconds = seconds_since(start);
    m_report.all_steps_seconds += m_report.step_seconds;
    if (m_report.n_outputs > 0) {
        say_cost(step);
    }
}

void InsituRun::make(std::uint64_t step, double time) {
    check_order(step, time);
    const auto is_due = [&](const auto& output) { return output->planned.is_due(step, time, m_last_time); };
    if (std::ranges::none_of(m_outputs, is_due)) {
        return;
    }
    m_report.read_bytes = sizeof(double) * m_volume->read_values();
    m_reductions->forget_fields();
    bool is_shared = false;
    for (const auto& output : m_outputs) {
        if (!is_due(output) || !is_wanted(*output, step, time)) {
            continue;
        }
        // Only pictures need values of elements that lie on other ranks.
        if (!is_shared && std::holds_alternative<PlannedPicture>(output->planned.what)) {
            const std::vector<std::uint32_t> changed = m_volume->share_values();
            for (const auto& [precision, drawn] : m_parts) {
                drawn->forget_fields(changed);
            }
            for (const auto& [precision, drawn] : m_renderers) {
                drawn->forget_fields();
            }
            is_shared = true;
        }
        write(*output, step, time);
        ++m_report.n_outputs;
    }
}

bool InsituRun::is_wanted(const Output& output, std::uint64_t step, double time) {
    return !output.planned.when || output.planned.when->value(*m_reductions, step, time) != 0;
}

void InsituRun::write(Output& output, std::uint64_t step, double time) {
    if (const auto* const picture = std::get_if<PlannedPicture>(&output.planned.what)) {
        draw(output, *picture, step);
    } else if (output.samples) {
        output.samples->write(prober(), step, time);
    } else {
        write_numbers(output, std::get<PlannedNumbers>(output.planned.what), step, time);
    }
}

VolumeInParts& InsituRun::parts(Precision precision) {
    std::unique_ptr<VolumeInParts>& drawn = m_parts[precision];
    if (!drawn) {
        const Device& device = m_context->device();
        log_line(LogLevel::info, "in situ: rank {} draws with {}", m_team.rank(), device.summary().name);
        drawn =
            std::make_unique<VolumeInParts>(*m_volume->parted(), device, precision, *m_volume->partition(), m_team, &m_control);
    }
    return *drawn;
}

Prober* InsituRun::prober() {
    if (!m_prober && m_volume->own() != nullptr) {
        m_prober.emplace(*m_volume->own());
    }
    return m_prober ? &*m_prober : nullptr;
}

Renderer& InsituRun::renderer(Precision precision) {
    std::unique_ptr<Renderer>& drawn = m_renderers[precision];
    if (!drawn) {
        drawn = std::make_unique<Renderer>(m_context->device(), m_volume->whole(), precision, &m_control);
    }
    return *drawn;
}

/** On the first rank; elsewhere empty. */
StillPicture InsituRun::picture_of(const Scene& scene, bool with_buffers) {
    const Precision precision = precision_of(scene);
    if (m_volume->parted() == nullptr) {
        StillOptions options;
        options.with_buffers = with_buffers;
        return draw_still(scene, m_volume->whole(), renderer(precision), options, &m_control);
    }
    VolumeInParts& drawn = parts(precision);
    PartsPicture picture = drawn.draw(scene, with_buffers);
    m_report.device_bytes = drawn.own_work().device_bytes;
    return std::move(picture.still);
}

void InsituRun::draw(const Output& output, const PlannedPicture& planned, std::uint64_t step) {
    Scene scene = planned.scene;
    scene.volume = volume_name;
    const StillPicture still = picture_of(scene, planned.with_buffers);
    if (!m_team.is_first()) {
        return;
    }
    for (const FrameRemark& remark : still.remarks) {
        log_line(remark.is_warning ? LogLevel::warning : LogLevel::info, "{}, step {}: {}", output.planned.name, step,
                 remark.text);
    }
    constexpr int bits = 8;
    write_png(still.frame, path(numbered(output.planned.name, step, ".png")), bits);
    if (planned.with_buffers) {
        write_buffers(still.frame, still.request, m_volume->whole(), path(numbered(output.planned.name, step, ".h5")),
                      precision_of(scene));
    }
}

void InsituRun::write_numbers(const Output& output, const PlannedNumbers& planned, std::uint64_t step, double time) {
    std::string row = std::to_string(step);
    append_csv_number(row, time);
    for (const Quantity& quantity : planned.quantities) {
        append_csv_number(row, quantity.value(*m_reductions, step, time));
    }
    if (output.numbers) {
        row += '\n';
        output.numbers->append(row);
    }
}

void InsituRun::say_cost(std::uint64_t step) {
    if (m_team.is_first()) {
        const elvis_insitu_report now = report();
        log_line(LogLevel::info, "in situ: step {}: {} in {:.3g} s, {} bytes read, {} sent; {:.1f} % of the run so far", step,
                 counted(now.n_outputs, "output"), now.step_seconds, now.read_bytes, now.sent_bytes,
                 100 * now.all_steps_seconds / now.run_seconds);
    }
}

elvis_insitu_report InsituRun::report() const {
    elvis_insitu_report now = m_report;
    now.run_seconds = seconds_since(m_opened);
    now.peak_memory_bytes = peak_memory();
    return now;
}

} // namespace elvis::library
