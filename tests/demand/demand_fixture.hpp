/**
 * @file demand_fixture.hpp
 * Pictures of a volume as a whole, and within budgets of memory.
 */
#pragma once

#include <core/demand/draw_on_demand.hpp>
#include <core/render/renderer.hpp>
#include <tests/support/files.hpp>
#include <tests/support/test_volumes.hpp>

#include <nlohmann/json.hpp>

#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace elvis::test {

/** A native volume from the generator. */
class DemandStage {
public:
    explicit DemandStage(const std::string& description, Precision precision = Precision::float32) : m_precision(precision) {
        oracle::generate(description, m_folder.path("volume.h5"));
        m_whole.emplace(oracle::open_volume(m_folder.path("volume.h5")));
    }

    const RuntimeVolume& volume() const { return *m_whole; }
    std::string path() const { return m_folder.path("volume.h5"); }

    /** Of a scene with these keys. */
    Scene scene(const std::string& keys) const {
        Scene made = scene_of(nlohmann::json::parse(R"({"version": 1, "image": {"size": [160, 120]}, )" + keys + "}"), "scene");
        made.volume = path();
        return made;
    }

    Frame as_whole(const Scene& scene) {
        if (!m_renderer) {
            m_renderer = std::make_unique<Renderer>(device(), *m_whole, m_precision);
        }
        return draw_still(scene, *m_whole, *m_renderer, {}).frame;
    }

    /** What it has on the device. */
    void forget_whole() { m_renderer.reset(); }

    Frame within(const MemoryBudget& budget, const Scene& scene) {
        VolumeOnDemand demand(*m_whole, device(), m_precision, budget);
        Frame frame = demand.draw(scene).frame;
        work = demand.work();
        return frame;
    }

    /** Of the last picture within a budget. */
    DemandWork work;

private:
    TemporaryFolder m_folder;
    Precision m_precision;
    std::optional<RuntimeVolume> m_whole;
    std::unique_ptr<Renderer> m_renderer;
};

/** Numbers that differ in a bit. */
template <class T> std::size_t n_different(const std::vector<T>& a, const std::vector<T>& b) {
    if (a.size() != b.size()) {
        return std::max(a.size(), b.size());
    }
    std::size_t n = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        n += std::memcmp(&a[i], &b[i], sizeof(T)) == 0 ? 0 : 1;
    }
    return n;
}

/** What of two pictures is not the same to the bit, for people. Empty: all is. */
inline std::string differences(const Frame& a, const Frame& b) {
    std::string text;
    const auto add = [&](const char* name, std::size_t n) {
        text += n > 0 ? std::string(name) + " " + std::to_string(n) + " " : "";
    };
    add("color", n_different(a.color, b.color));
    add("value", n_different(a.value, b.value));
    add("depth", n_different(a.depth, b.depth));
    add("element", n_different(a.element, b.element));
    add("normal", n_different(a.normal, b.normal));
    add("flags", n_different(a.flags, b.flags));
    return text;
}

} // namespace elvis::test
