/**
 * @file handles.hpp
 * What is behind the handles of elvis.h.
 */
#pragma once

#include "arrays.hpp"

#include <core/arrows/scene_arrows.hpp>
#include <core/base/cancel.hpp>
#include <core/base/host.hpp>
#include <core/demand/draw_on_demand.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/probe/probe.hpp>
#include <core/render/renderer.hpp>
#include <core/scene/scene.hpp>
#include <core/session/animation_pictures.hpp>
#include <core/session/picture_stats.hpp>
#include <core/session/screen_picture.hpp>
#include <core/session/still_picture.hpp>
#include <core/session/streamline_tubes.hpp>
#include <core/session/volume/extrema_finder.hpp>
#include <core/streamline/trace.hpp>
#include <core/vulkan/device.hpp>

#include <elvis/answers.h>
#include <elvis/elvis.h>
#include <nlohmann/json.hpp>

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace elvis::library {

/** A context: kept by all that was made with it. */
struct Context {
    explicit Context(const elvis_context_options& options);
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    /** Opened when first asked for. */
    const Device& device();
    /** Those that draw besides, with ELVIS_CONTEXT_SEVERAL_DEVICES; opened when first asked for. */
    const std::vector<std::unique_ptr<Device>>& other_devices();
    /** Those that nobody draws with, on devices that are open. */
    void forget_kernels();
    /** Main memory of the process, on devices that are open or will be; 0: no limit. */
    void limit_memory(std::uint64_t bytes);

    /** First: all that follows works for it. */
    Host host;
    std::optional<PluginRegistry> plugins;
    /** By name, or empty. */
    std::string wanted_device;
    bool is_validated = false;

private:
    std::mutex m_mutex;
    std::optional<Device> m_device;
    std::uint64_t m_most_bytes = 0;
    std::vector<std::string> m_wanted_others;
    std::vector<std::unique_ptr<Device>> m_others;
};

/** Data: kept by its pictures. What is below `mutex` is for one thread at a time. */
struct Data {
    /** `watch` is what the volume was opened with. */
    Data(std::shared_ptr<Context> with, std::unique_ptr<TaskControl> watch, RuntimeVolume of);
    ~Data();
    Data(const Data&) = delete;
    Data& operator=(const Data&) = delete;

    /** Of that precision; the other precision's is given up: a volume is on the device once. */
    Renderer& renderer(Precision precision);
    /** Of that precision, on the context's other devices. */
    std::vector<Renderer*> other_renderers(Precision precision);
    /** Draws with that precision within that budget. What renderers have on devices is given up. */
    VolumeOnDemand& on_demand(Precision precision, const MemoryBudget& budget);
    /** Those of expressions are sampled where the renderer has its data, if there is one. */
    FieldExtrema extrema_of(const FieldChoice& field, std::uint32_t time_step);
    /** Evaluating that way; the one before is given up. */
    Prober& prober(ProbeOptions::Evaluation evaluation);
    /** Displaced; those before are given up. Throws Error where the geometry cannot be displaced so. */
    std::shared_ptr<Data> warped(const SceneWarp& warp, std::uint32_t time_step);
    /** What pictures and values keep for those to come, on devices and beside them. */
    void forget_work();
    /** Values of a field, or of all, have changed. */
    void forget_fields(std::optional<std::uint32_t> only);
    /** min x y z, max x y z. */
    const std::array<double, 6>& bounds();

    const std::shared_ptr<Context> context;
    /** Follows the call that has the mutex: what volume and renderer were made with lives longer than a call. */
    const std::unique_ptr<TaskControl> control;
    /** Opens the volume once more; empty where it is not from a file. It keeps a temporary file, which outlasts the volume. */
    std::function<RuntimeVolume()> reopen;
    /** What a native volume's numbers come from; empty for others. */
    std::function<std::shared_ptr<const native::VolumeSource>()> source;
    const RuntimeVolume volume;

    std::mutex mutex;
    /** Of data from arrays. */
    std::unique_ptr<Arrays> arrays;
    ExtremaFinder extrema;
    StreamlineTubes streamlines;
    SceneArrowSets arrow_sets;
    /** Of scenes with several volumes: the other ones, by what opens them. */
    std::map<std::string, std::shared_ptr<Data>> beside;

private:
    /** The volume on another device. A volume takes one call at a time: each device has its own. */
    struct Other {
        RuntimeVolume volume;
        std::optional<Renderer> renderer;
    };

    struct OnDemand {
        Precision precision;
        MemoryBudget budget;
        VolumeOnDemand drawing;
    };

    struct Warped {
        SceneWarp warp;
        std::uint32_t time_step = 0;
        std::shared_ptr<Data> data;
    };

    std::optional<Warped> m_warped;
    std::optional<Prober> m_prober;
    ProbeOptions::Evaluation m_evaluation = ProbeOptions::Evaluation::automatic;
    std::optional<Renderer> m_renderer;
    std::unique_ptr<OnDemand> m_on_demand;
    std::vector<std::unique_ptr<Other>> m_others;
    Precision m_others_precision = Precision::float32;
    Precision m_precision = Precision::float32;
    std::optional<std::array<double, 6>> m_bounds;
};

/** What files hold. */
std::shared_ptr<Data> open_data(const std::shared_ptr<Context>& context, const std::vector<std::string>& paths,
                                const std::string& plugin, const std::string& options, const elvis_task* task);

/** Data whose fields are joined: see elvis_join. */
struct JoinedData {
    std::string name;
    std::shared_ptr<Data> data;
    std::optional<std::uint32_t> time_step;
};

/** Data with the fields of others beside their own. No data is in use by the caller. */
std::shared_ptr<Data> join_data(const std::shared_ptr<Data>& data, const std::vector<JoinedData>& others,
                                const elvis_task* task);

/** A scene: the document, what it says, and the file beside which it is. */
struct SceneState {
    std::shared_ptr<Context> context;
    nlohmann::json document;
    std::string file;
    Scene scene;
};

struct Picture {
    std::shared_ptr<Data> data;
    Precision precision = Precision::float32;
    std::variant<StillPicture, ScreenPicture> drawn;
    PictureStats stats;
    /** Of a picture within a budget. */
    std::optional<DemandWork> demand{};

    const Frame& frame() const {
        return std::visit([](const auto& picture) -> const Frame& { return picture.frame; }, drawn);
    }
    const std::vector<FrameRemark>& remarks() const {
        return std::visit([](const auto& picture) -> const std::vector<FrameRemark>& { return picture.remarks; }, drawn);
    }
};

struct Lines {
    std::shared_ptr<Context> context;
    std::vector<Streamline> lines;
    /** Of the points of all lines. */
    std::vector<std::int64_t> elements;
    std::uint32_t n_values = 0;
    std::vector<double> values;
};

struct Animation {
    std::shared_ptr<Data> data;
    Precision precision = Precision::float32;
    AnimationPictures pictures;
};

} // namespace elvis::library

struct elvis_context {
    std::shared_ptr<elvis::library::Context> state;
};
struct elvis_data {
    std::shared_ptr<elvis::library::Data> state;
};
struct elvis_scene {
    elvis::library::SceneState state;
};
struct elvis_picture {
    elvis::library::Picture state;
};
struct elvis_lines {
    elvis::library::Lines state;
};
struct elvis_animation {
    elvis::library::Animation state;
};
