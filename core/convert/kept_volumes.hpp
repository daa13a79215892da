/**
 * @file kept_volumes.hpp
 * Conversions that are kept in the cache: a foreign data set is converted once, and again when one of its files has changed.
 *
 * Each is a folder `volumes/KEY` of the cache (core/base/cache.hpp) with the volume and the conversion's report. It is made
 * under a temporary name and renamed. All together take at most $ELVIS_VOLUME_CACHE_MIB mebibytes, 20480 by default; those that
 * were not used for the longest time go first, and the newest stays whatever its size. 0: nothing is kept.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/base/temporary_folder.hpp>
#include <core/convert/convert.hpp>

#include <memory>
#include <string>
#include <vector>

namespace elvis {

class Plugin;

struct KeptVolume {
    /** Of the native volume. */
    std::string path;
    ConvertReport report;
    /** It was not there before. */
    bool is_new = false;
    /** Where nothing is kept: what holds the volume, which goes with it. */
    std::shared_ptr<const TemporaryFolder> folder;
};

/** Takes the conversion that is there, or converts. `options` of the plugin, JSON or empty. */
KeptVolume kept_volume(const std::shared_ptr<const Plugin>& plugin, const std::vector<std::string>& inputs,
                       const std::string& options, const TaskControl& control);

/** "exact", or what is lost where: for people. */
std::string exactness(const ConvertReport& report);
bool is_exact(const ConvertReport& report);

} // namespace elvis
