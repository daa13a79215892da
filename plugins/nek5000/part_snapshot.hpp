/**
 * @file part_snapshot.hpp
 * One time step in the format since 2006: a file or several parts, with elements in any order.
 */
#pragma once

#include "part_header.hpp"
#include "snapshot.hpp"

#include <mutex>

namespace elvis_nek5000 {

class PartSnapshot : public Snapshot {
public:
    /** Reads the headers of all parts; `path` is any of them. */
    PartSnapshot(const std::string& path, OpenFiles& files);

    /** The path of the first part of a time step of which `path` is any; the path itself if its name does not tell. */
    static std::string first_part(const std::string& path, OpenFiles& files);

    void read(std::size_t block, std::uint64_t element, std::span<double> values) const override;
    std::uint32_t part(std::uint64_t element) const override;
    void forget() const override;
    Precision precision() const override {
        return m_parts.front().header.format.real_size == 8 ? double_precision : single_precision;
    }

private:
    struct Part {
        std::string path;
        PartHeader header;
    };
    /** Where an element's values are. */
    struct Place {
        std::uint32_t part = 0;
        std::uint32_t index = 0;
    };
    using Places = std::vector<Place>;

    static std::vector<Part> find_parts(const std::string& path, OpenFiles& files);
    PartSnapshot(std::vector<Part> parts, OpenFiles& files);
    std::shared_ptr<const Places> places() const;
    Places read_places() const;

    OpenFiles& m_files;
    std::vector<Part> m_parts;
    mutable std::mutex m_mutex;
    mutable std::shared_ptr<const Places> m_places;
};

} // namespace elvis_nek5000
