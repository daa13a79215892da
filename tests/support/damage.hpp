/**
 * @file damage.hpp
 * Files that a conversion plugin has to refuse or to read, and processes that find out whether it does.
 */
#pragma once

#include <catch2/catch.hpp>
#include <core/base/error.hpp>
#include <core/plugin_host/source_volume.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace elvis::test {

/** Read, refused with the name of the file, refused without it, ended by a signal. */
enum class Outcome { read, refused, silent, ended };

/**
 * Whether an outcome is as it should be. HDF5 1.10 follows pointers that it never set in damaged lists of attributes: the
 * address sanitizer, which fills memory with other numbers than zero, ends one file of 600 there (H5Aexists).
 */
inline bool is_right(Outcome outcome) {
#ifdef __SANITIZE_ADDRESS__
    return outcome != Outcome::silent;
#else
    return outcome == Outcome::read || outcome == Outcome::refused;
#endif
}

/** Opens, and asks for all that a conversion asks for. Messages have to contain `name`. */
inline Outcome try_to_read(const std::function<SourceVolume()>& open, const std::string& name) {
    try {
        const SourceVolume source = open();
        std::vector<elvis_source_element> elements(source.info().n_elements);
        source.elements(0, elements.size(), elements);
        const std::array<double, 3> xi = {-0.7, -0.8, -0.9};
        std::array<double, 3> x{};
        std::vector<double> values(source.n_values());
        for (std::uint64_t element = 0; element < elements.size(); element += 3) {
            source.evaluate_mapping(element, xi, x);
            source.sample(0, element, xi, values);
        }
        return Outcome::read;
    } catch (const Error& error) {
        return std::string(error.what()).find(name) != std::string::npos ? Outcome::refused : Outcome::silent;
    }
}

/** The same in a process of its own, which may take 10 seconds and 2 GiB. */
inline Outcome outcome(const std::function<SourceVolume()>& open, const std::string& name) {
    // Sanitizers end programs with 1.
    constexpr int first_status = 40;
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
#ifndef __SANITIZE_ADDRESS__ // It takes terabytes of addresses.
        const rlimit memory{std::uint64_t{1} << 31, std::uint64_t{1} << 31};
        setrlimit(RLIMIT_AS, &memory);
#endif
        alarm(10);
        _exit(first_status + static_cast<int>(try_to_read(open, name)));
    }
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    const int known = WIFEXITED(status) ? WEXITSTATUS(status) - first_status : -1;
    return known >= 0 && known < static_cast<int>(Outcome::ended) ? static_cast<Outcome>(known) : Outcome::ended;
}

/** A few bytes or a run of them changed, a part left out, or the end cut off. */
inline std::string damaged(std::string content, std::mt19937& random) {
    const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
    switch (below(5)) {
    case 0:
        content.resize(below(content.size()));
        break;
    case 1:
        content.erase(below(content.size()), 1 + below(64));
        break;
    case 2: {
        const std::size_t first = below(content.size());
        content.replace(first, std::min<std::size_t>(8, content.size() - first),
                        std::string(8, static_cast<char>(below(2) * 255)));
        break;
    }
    default:
        for (std::size_t n = 1 + below(4); n > 0; --n) {
            content[below(content.size())] = static_cast<char>(below(256));
        }
    }
    return content;
}

} // namespace elvis::test
