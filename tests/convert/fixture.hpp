/**
 * @file fixture.hpp
 * What the conversion tests share.
 */
#pragma once

#include <core/convert/convert.hpp>
#include <core/plugin_host/source_volume.hpp>
#include <elvis/native/volume_file.hpp>
#include <tests/support/files.hpp>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

using elvis::test::names_in;
using elvis::test::TemporaryFolder;

/** The data set that a description stands for; the generator reads it when it is opened. */
elvis::SourceVolume generate(const std::string& description);

/** A file of the original ElVis. */
elvis::SourceVolume open_dat(const std::string& path);

/** A converted volume, wholly in memory; elements by their number. */
class ConvertedVolume {
public:
    /** Converts and reads back. */
    explicit ConvertedVolume(const elvis::SourceVolume& source, const elvis::ConvertOptions& options = {});

    const elvis::ConvertReport& report() const { return m_report; }
    const elvis::native::Description& description() const { return m_description; }
    const std::vector<elvis::native::Face>& faces() const { return m_faces; }
    std::uint64_t n_elements() const { return m_place.size(); }
    elvis::native::Shape shape(std::uint64_t element) const;
    std::vector<double> field_coefficients(std::uint64_t element, std::size_t field, std::size_t component,
                                           std::size_t step) const;

    /** Position and, by rows of x, its derivatives with respect to xi. */
    std::array<double, 3> position(std::uint64_t element, const elvis::native::Point& xi,
                                   std::array<elvis::native::Point, 3>* jacobian = nullptr) const;
    /** Value and, if wanted, the gradient in world coordinates. */
    double value(std::uint64_t element, std::size_t field, const elvis::native::Point& xi,
                 elvis::native::Point* gradient = nullptr, std::size_t component = 0, std::size_t step = 0) const;

private:
    struct Place {
        std::size_t element_class;
        std::uint64_t index;
    };
    elvis::ConvertReport m_report;
    elvis::native::Description m_description;
    std::vector<Place> m_place;
    std::vector<elvis::native::Face> m_faces;
    /** By class. */
    std::vector<std::vector<double>> m_geometry;
    /** By step, field, class. */
    std::vector<std::vector<std::vector<std::vector<double>>>> m_fields;
};

/** A point in a reference shape, uniform in collapsed coordinates; the sequence is the same in every run. */
elvis::native::Point random_point(elvis::native::Shape shape);
