/**
 * @file serve.hpp
 * A volume in the browser: what `elvis serve` runs.
 */
#pragma once

#include <elvis/elvis.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace elvis::serve {

struct Options {
    /** A scene, or the files of a volume. */
    std::vector<std::string> files;
    std::string address = "127.0.0.1";
    /** 0: one that is free. */
    std::uint16_t port = 8080;
    /** Beside that of the page itself: where pages may come from that open a session, "https://host". */
    std::vector<std::string> origins;
    /** Files that scenes of the page may name lie below; empty: the folder of the first file. */
    std::string root;
    /** The server ends when its standard input does, and so with the program that has started it. */
    bool ends_with_input = false;
    std::size_t most_sessions = 8;
    /** Mebibytes that all sessions together and the volume may take; 0: as many as there are. */
    std::uint64_t most_memory = 0;
    std::size_t most_connections = 256;
};

/**
 * Opens the volume, tells `on_url` where the page is, and serves until an interrupt or a polite kill. `open` makes data of a
 * function that takes a task. Throws std::exception.
 */
void run(const context& library, const Options& options,
         const std::function<data(const std::function<data(const task&)>&)>& open,
         const std::function<void(const std::string& url)>& on_url);

} // namespace elvis::serve
