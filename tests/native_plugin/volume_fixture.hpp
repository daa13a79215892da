/**
 * @file volume_fixture.hpp
 * A native volume with random curved elements and random fields, in a file, with its coefficients kept for comparison.
 */
#pragma once

#include "spaces.hpp"

#include <core/base/temporary_folder.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <elvis/native/volume_file.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace elvis::test {

/** One class of elements to be made. */
struct ClassPlan {
    native::Space geometry;
    /** One for each field. */
    std::vector<native::Space> fields;
    std::uint64_t n_elements = 3;
};

class TestVolume {
public:
    /**
     * Elements are the reference shape, moved by `centre` in every direction, with every geometry coefficient disturbed by up
     * to `bend`. Element numbers run backwards. Fields are random, or the projection of `function` of xi where that is given.
     */
    TestVolume(std::vector<ClassPlan> classes, std::vector<native::Field> fields, std::vector<double> times = {0.0},
               double centre = 0, double bend = 0.02, const std::function<double(const native::Point&)>& function = {});

    const std::string& path() const { return m_file.path(); }
    const native::Description& description() const { return m_description; }
    std::uint64_t first_element(std::size_t element_class) const;

    std::span<const double> geometry(std::size_t element_class, std::uint64_t local, std::size_t direction) const;
    std::span<const double> field(std::size_t field, std::size_t time_step, std::size_t element_class, std::uint64_t local,
                                  std::size_t component) const;

    /** Opened by the plugin under test. */
    RuntimeVolume open() const;

    static native::Face example_face() { return {2, 0, 1, 3, 1}; }

private:
    TemporaryFile m_file{"volume.h5"};
    native::Description m_description;
    std::vector<std::vector<double>> m_geometry;
    /** [(field * n_times + time) * n_classes + class] */
    std::vector<std::vector<double>> m_fields;
};

/** The plugin under test. */
std::shared_ptr<const Plugin> native_plugin();

/** Coefficients of a function that lies in the space. */
std::vector<double> fit(const native::Space& space, const std::function<double(const native::Point&)>& function);

} // namespace elvis::test
