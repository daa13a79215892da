/**
 * @file histograms.hpp
 * Histograms of fields, which grow piece by piece and are shared by all sessions.
 */
#pragma once

#include <apps/elvis/view/model/histogram.hpp>
#include <apps/elvis/view/scene/scene.hpp>

#include <elvis/elvis.hpp>

#include <nlohmann/json.hpp>

#include <map>
#include <mutex>
#include <string>

namespace elvis::serve {

struct Served;

/** For any thread. */
class Histograms {
public:
    /**
     * Samples the field for a twentieth of a second, if there is something left to sample, and tells what is known: `lower` and
     * `upper` of the field, `bins` between them as fractions of the largest one, `quantiles` (2, 10, 90, 98 %), `is_complete`.
     */
    nlohmann::json grow(const Served& served, const view::Scene& scene, const std::string& field, const task& watch);

private:
    struct Entry {
        view::Histogram histogram;
        unsigned n_pieces = 0;
    };

    std::mutex m_mutex;
    std::map<std::string, Entry> m_entries;
};

} // namespace elvis::serve
