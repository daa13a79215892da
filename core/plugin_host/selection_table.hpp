/**
 * @file selection_table.hpp
 * A selection of elements, seen as a plugin's volume: each question is handed on to the whole.
 */
#pragma once

#include <core/plugin_host/handed_on_table.hpp>
#include <core/plugin_host/selected_volume.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace elvis {

class SelectionTable : public HandedOnTable {
public:
    /** Not asked: volumes are made by selected_volume(). */
    static std::uint32_t probe(const char*) { return 0; }
    SelectionTable(const api::Host& host, const std::string& path, const std::string& options);
    SelectionTable(const api::Host& host, const elvis::RuntimeVolume& whole, std::vector<std::uint64_t> elements,
                   SelectedFaces faces);

private:
    void for_each_run(std::uint64_t first, std::uint64_t count, const Read& read) const override;
    void select_faces();
    std::int64_t position(std::int64_t element) const;

    std::vector<std::uint64_t> m_elements;
};

} // namespace elvis
