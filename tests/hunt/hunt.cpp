#include "hunt.hpp"

#include "scenes.hpp"
#include "sums.hpp"
#include "twins.hpp"
#include "volumes.hpp"

#include <core/base/error.hpp>
#include <core/base/temporary_folder.hpp>
#include <core/convert/convert.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/render/renderer.hpp>
#include <core/scene/frame_request.hpp>
#include <core/scene/write/write_scene.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>

namespace elvis::hunt {
namespace {

namespace fs = std::filesystem;

/** Neighbouring numbers share a volume and its kernels, which take longer to compile than most pictures take. */
constexpr std::uint64_t scenes_of_a_volume = 60;

/** Scenes of which one pixel in so many is flagged without a reason are named. */
constexpr std::uint64_t most_false_alarms = 100;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/** An open volume with its renderers and what the oracle reads. */
struct Ground {
    Ground(const Device& device, const PluginRegistry& plugins, const std::string& volume_path)
        : path(volume_path), volume(plugins.runtime_for(path), path), oracle(path, faces_of(volume)) {
        renderers[0].emplace(device, volume, Precision::float32);
        renderers[1].emplace(device, volume, Precision::float64);
    }
    static std::vector<elvis_face> faces_of(const RuntimeVolume& volume) {
        std::vector<elvis_face> faces(volume.n_faces());
        volume.faces(0, faces.size(), faces);
        return faces;
    }
    std::string path;
    RuntimeVolume volume;
    oracle::SceneVolume oracle;
    std::optional<Renderer> renderers[2];
    /** The same with each class in two, if that is to be judged, too. */
    std::unique_ptr<Ground> split;
};

const std::vector<std::pair<std::string, Sharing>>& sharings() {
    static const std::vector<std::pair<std::string, Sharing>> all{
        {"none", Sharing::none()}, {"rows", {false, true}}, {"depths", {true, false}}, {"all", Sharing::all()}};
    return all;
}

class Hunt {
public:
    explicit Hunt(const Options& options) : m_options(options), m_device(options.device) {
        for (const std::string& name : options.precisions)
            m_precisions.push_back(*precision_named(name));
        if (!options.folder.empty())
            fs::create_directories(options.folder);
    }

    void judge_files();
    void judge_random();
    int report();

private:
    void judge_volume(std::uint64_t number, std::uint64_t first, std::uint64_t end);
    void judge_scene(Ground& ground, const SceneGround& scene_ground, std::string_view kind, std::uint64_t number,
                     const std::string& description);
    void judge(Ground& ground, const Scene& scene, const std::string& kind, const std::string& name, const std::string& origin);
    void judge_picture(Ground& ground, const Judge& judge, const FrameRequest& request, Scene scene, const std::string& kind,
                       const std::string& name, const std::string& origin);
    void report_findings(const Scene& scene, const std::string& name, const std::string& origin, Precision precision,
                         const Judgement& judgement);
    void report_false_alarms(const Scene& scene, const std::string& name, const std::string& origin, Precision precision,
                             const Tally& tally);
    void write(const Scene& scene, const std::string& name, const std::string& text);
    bool is_wanted(std::string_view kind) const {
        return m_options.kinds.empty() || std::ranges::find(m_options.kinds, kind) != m_options.kinds.end();
    }
    bool is_over() const { return seconds_since(m_start) > m_options.seconds; }

    const Options& m_options;
    std::chrono::steady_clock::time_point m_start = std::chrono::steady_clock::now();
    PluginRegistry m_plugins;
    Device m_device;
    std::vector<Precision> m_precisions;
    Sums m_sums;
    std::uint64_t m_n_scenes = 0, m_n_unknown = 0, m_n_failed = 0;
};

std::array<std::uint32_t, 2> parse_size(const std::string& text) {
    unsigned width = 0, height = 0;
    if (std::sscanf(text.c_str(), "%ux%u", &width, &height) != 2 || width == 0 || height == 0)
        throw Error("--size", "is like 200x150");
    return {width, height};
}

/** Writes meshes that are in memory alone, and names their files in the scene. `start`: of their paths. */
void write_meshes(Scene& scene, const std::string& start) {
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
        auto* cut = std::get_if<CutShape>(&scene.surfaces[i].geometry);
        auto* shape = cut == nullptr ? nullptr : std::get_if<MeshSurface>(cut);
        if (shape == nullptr || !shape->mesh->path.empty())
            continue;
        auto mesh = std::make_shared<TriangleMesh>(*shape->mesh);
        mesh->path = start + "_" + std::to_string(i) + ".obj";
        std::ofstream file(mesh->path);
        file.precision(17);
        for (const Vector3& point : mesh->points)
            file << "v " << point[0] << ' ' << point[1] << ' ' << point[2] << '\n';
        for (const auto& triangle : mesh->triangles)
            file << "f " << triangle[0] + 1 << ' ' << triangle[1] + 1 << ' ' << triangle[2] + 1 << '\n';
        shape->mesh = mesh;
    }
}

void Hunt::write(const Scene& scene, const std::string& name, const std::string& text) {
    const fs::path folder = m_options.folder;
    Scene copy = scene;
    copy.volume = (folder / (name + ".vol.h5")).string();
    if (fs::absolute(copy.volume) != fs::absolute(scene.volume))
        fs::copy_file(scene.volume, copy.volume, fs::copy_options::overwrite_existing);
    write_meshes(copy, (folder / name).string());
    write_scene(copy, (folder / (name + ".json")).string());
    std::ofstream(folder / (name + ".txt"), std::ios::app) << text;
}

void Hunt::report_findings(const Scene& scene, const std::string& name, const std::string& origin, Precision precision,
                           const Judgement& judgement) {
    const Tally& tally = judgement.tally;
    std::string text = name + " " + name_of(precision) + ": " + std::to_string(tally.far) + " far, " +
                       std::to_string(tally.near) + " near, of " + std::to_string(tally.pixels) + " (" + origin + ")\n";
    for (const Finding& finding : judgement.findings) {
        text += "  row " + std::to_string(finding.row) + " column " + std::to_string(finding.column) +
                (finding.verdict == Verdict::far ? " far:" : " near:");
        for (const auto& [bit, buffer_name] : buffer::names)
            if ((finding.wrong & bit) != 0)
                text.append(" ").append(buffer_name);
        text += "\n    shown " + finding.shown + "\n    true  " + finding.truth + "\n";
    }
    if (!m_options.is_quiet)
        std::printf("%s", text.c_str());
    if (!m_options.folder.empty())
        write(scene, name, text);
    std::fflush(stdout);
}

void Hunt::report_false_alarms(const Scene& scene, const std::string& name, const std::string& origin, Precision precision,
                               const Tally& tally) {
    const std::string text = name + " " + name_of(precision) + ": " + std::to_string(tally.all_false_alarms) +
                             " false alarms, of " + std::to_string(tally.pixels) + " (" + origin + ")\n";
    if (!m_options.is_quiet)
        std::printf("%s", text.c_str());
    if (!m_options.folder.empty())
        write(scene, name, text);
    std::fflush(stdout);
}

void Hunt::judge(Ground& ground, const Scene& scene, const std::string& kind, const std::string& name,
                 const std::string& origin) {
    ++m_n_scenes;
    FrameRequest request = make_frame_request(scene, ground.volume, ground.renderers[0]->ranges());
    const std::size_t turn = std::hash<std::string>{}(name) % sharings().size();
    for (const auto& [sharing_name, sharing] : sharings())
        if (m_options.sharing.empty() ? sharing_name == sharings()[turn].first : sharing_name == m_options.sharing)
            request.sharing = sharing;
    std::string reason;
    Judge judge(ground.oracle, request, reason);
    if (!reason.empty()) {
        ++m_n_unknown;
        if (!m_options.is_quiet)
            std::printf("%s: the oracle does not know %s\n", name.c_str(), reason.c_str());
        return;
    }
    judge.draw();
    m_sums[{kind, name_of(m_precisions.front())}].oracle_seconds += judge.seconds();
    judge_picture(ground, judge, request, scene, kind, name, origin);
    if (const std::optional<FrameRequest> smaller = smaller_picture(request))
        judge_picture(ground, Judge(judge, *smaller), *smaller, scene, kind + "/small", name + "_small", origin);
    if (ground.split && !hangs_on_bounds(request))
        judge_picture(*ground.split, judge, request, scene, kind + "/split", name + "_split", origin);
}

void Hunt::judge_picture(Ground& ground, const Judge& judge, const FrameRequest& request, Scene scene, const std::string& kind,
                         const std::string& name, const std::string& origin) {
    scene.volume = ground.path;
    scene.size = {request.width, request.height};
    for (const Precision precision : m_precisions) {
        const auto start = std::chrono::steady_clock::now();
        const Frame frame = ground.renderers[precision == Precision::float64 ? 1 : 0]->render(request);
        const double seconds = seconds_since(start);
        Judgement judgement = judge.judge(frame, precision);
        judgement.tally.render_seconds = seconds;
        m_sums[{kind, name_of(precision)}] += judgement.tally;
        if (judgement.tally.all_false_alarms * most_false_alarms > judgement.tally.pixels)
            report_false_alarms(scene, name, origin, precision, judgement.tally);
        if (!judgement.findings.empty())
            report_findings(scene, name, origin, precision, judgement);
    }
}

void Hunt::judge_files() {
    for (const std::string& file : m_options.scene_files) {
        Scene scene = read_scene(file);
        const TemporaryFile converted("volume.h5");
        if (native::Reader::probe(scene.volume) == 0) {
            const SourceVolume source(m_plugins.converter_for(scene.volume), {scene.volume});
            convert(source, converted.path(), {}, {});
            scene.volume = converted.path();
        }
        if (!m_options.size.empty())
            scene.size = parse_size(m_options.size);
        scene.annotation.reset();
        Ground ground(m_device, m_plugins, scene.volume);
        const TemporaryFile split_file("split.h5");
        if (m_options.splits) {
            split_classes(scene.volume, split_file.path(), true);
            ground.split = std::make_unique<Ground>(m_device, m_plugins, split_file.path());
        }
        judge(ground, scene, "files", fs::path(file).stem().string(), file);
    }
}

void Hunt::judge_scene(Ground& ground, const SceneGround& scene_ground, std::string_view kind, std::uint64_t number,
                       const std::string& description) {
    if (!is_wanted(kind))
        return;
    Scene scene = make_scene(scene_ground, kind, number);
    if (!m_options.size.empty())
        scene.size = parse_size(m_options.size);
    const bool is_of_first_list = std::ranges::find(kinds, kind) != kinds.end();
    const std::string name = (is_of_first_list ? "scene" : std::string(kind)) + "_" + std::to_string(number);
    try {
        judge(ground, scene, std::string(kind), name, description);
    } catch (const std::exception& error) {
        ++m_n_failed;
        std::printf("%s (%s, %s): %s\n", name.c_str(), std::string(kind).c_str(), description.c_str(), error.what());
    }
}

void Hunt::judge_volume(std::uint64_t number, std::uint64_t first, std::uint64_t end) {
    const TemporaryFile file("volume.h5");
    const std::string description = make_volume(m_plugins, number, m_options.files, file.path());
    Ground ground(m_device, m_plugins, file.path());
    if (ground.volume.fields().empty())
        throw Error(description, "has no field");
    const TemporaryFile split_file("split.h5");
    if (m_options.splits || number % 3 == 1) {
        split_classes(file.path(), split_file.path(), number % 2 == 1);
        ground.split = std::make_unique<Ground>(m_device, m_plugins, split_file.path());
    }
    oracle::Random random(number + 77);
    const auto field = static_cast<std::uint32_t>(random.whole(0, static_cast<int>(ground.volume.fields().size()) - 1));
    const oracle::Volume& volume = ground.oracle.model(field, 0).volume;
    const SceneGround scene_ground =
        ground_of(file.path(), ground.volume.fields()[field].name, volume, ground.volume.n_faces() > 0);
    for (std::uint64_t scene_number = first; scene_number < end && !is_over(); ++scene_number) {
        judge_scene(ground, scene_ground, kinds[scene_number % kinds.size()], scene_number, description);
        for (const std::string_view kind : more_kinds)
            judge_scene(ground, scene_ground, kind, scene_number, description);
    }
}

void Hunt::judge_random() {
    const std::uint64_t end = m_options.n_scenes == 0 ? ~std::uint64_t{0} : m_options.first + m_options.n_scenes;
    for (std::uint64_t first = m_options.first; first < end && !is_over();) {
        const std::uint64_t volume = first / scenes_of_a_volume;
        const std::uint64_t last = std::min(end, (volume + 1) * scenes_of_a_volume);
        try {
            judge_volume(volume, first, last);
        } catch (const std::exception& error) {
            std::printf("volume %llu: %s\n", static_cast<unsigned long long>(volume), error.what());
        }
        first = last;
    }
}

int Hunt::report() {
    std::printf("%s%llu scenes, %llu that the oracle does not know, %.0f s\n", to_text(m_sums).c_str(),
                static_cast<unsigned long long>(m_n_scenes), static_cast<unsigned long long>(m_n_unknown),
                seconds_since(m_start));
    if (!m_options.json.empty())
        write_sums(m_sums, m_options.json);
    if (m_sums.empty())
        std::printf("no pixel was judged\n");
    return has_silent(m_sums) || m_n_failed > 0 || m_sums.empty() ? 1 : 0;
}

} // namespace

int hunt(const Options& options) {
    Hunt hunt(options);
    if (options.scene_files.empty())
        hunt.judge_random();
    else
        hunt.judge_files();
    return hunt.report();
}

int print_sum(const std::vector<std::string>& files, const std::string& json) {
    Sums sums;
    for (const std::string& file : files)
        add_sums(file, sums);
    std::printf("%s", to_text(sums).c_str());
    if (!json.empty())
        write_sums(sums, json);
    return has_silent(sums) ? 1 : 0;
}

} // namespace elvis::hunt
