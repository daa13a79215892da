/**
 * @file defective_data.hpp
 * What both interfaces of the defective plugin have: its file, its defects, its mapping and field.
 */
#pragma once

#include <elvis/converter.h>
#include <elvis/host.h>

#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

namespace defective {

/** Whether this is the defect to have. */
inline bool has(std::string_view defect) {
    static const char* const wanted = std::getenv("ELVIS_DEFECT");
    return wanted && defect == wanted;
}

inline std::atomic<int> n_opened{0}; ///< ever
inline std::atomic<int> n_open{0};   ///< now
inline std::atomic<int> n_inside{0}; ///< calls of evaluate at this moment

/** What both interfaces open. */
struct Data {
    const elvis_host* host = nullptr;
    double scale = 1;
    std::string name = "bend";
    char* lost = nullptr; ///< never released
};

inline elvis_result fail(const elvis_host* host, elvis_result code, const char* file, const char* message) {
    if (!has("open-silent")) {
        host->set_error(host, file, message);
    }
    return has("open-wrong-code") ? 42 : code;
}

inline bool is_ours(const char* path) {
    char head[11] = {};
    std::FILE* file = std::fopen(path, "rb");
    const bool is_whole = file && std::fread(head, 1, 10, file) == 10;
    if (file) {
        std::fclose(file);
    }
    if (has("probe-crash") && !is_whole) {
        std::abort();
    }
    if (has("probe-slow")) {
        ::usleep(600000);
    }
    return (is_whole && std::strcmp(head, "defective ") == 0 && !has("probe-none")) || has("probe-all");
}

inline elvis_result read(const elvis_host* host, const char* path, Data& data) {
    std::FILE* file = std::fopen(path, "rb");
    if (!file) {
        return has("open-anything") ? ELVIS_OK : fail(host, ELVIS_ERROR_FILE, path, "cannot be read");
    }
    char text[100] = {};
    const std::size_t size = std::fread(text, 1, sizeof text - 1, file);
    if (!has("leak-file")) {
        std::fclose(file);
    }
    if (has("open-anything")) {
        return ELVIS_OK;
    }
    if (std::strncmp(text, "defective 1\n", 12) != 0) {
        return fail(host, ELVIS_ERROR_FORMAT, path, "line 1: 'defective 1' is expected");
    }
    char* end = nullptr;
    data.scale = std::strtod(text + 12, &end);
    const bool is_sound = end != text + 12 && end == text + size - 1 && *end == '\n' && data.scale > 0 && data.scale < 1e6;
    if (!is_sound && has("damage-crash")) {
        std::abort();
    }
    if (!is_sound && !has("damage-nonsense")) {
        return fail(host, ELVIS_ERROR_FORMAT, path, "line 2: a positive number is expected, and nothing behind it");
    }
    return ELVIS_OK;
}

/** The part of open that both interfaces have. */
inline elvis_result open_data(const elvis_host* host, const char* path, const char* options, Data& data) {
    if (has("options-crash") && options && options[0] != '{') {
        std::abort();
    }
    if (has("cancel-uncalled")) {
        return ELVIS_ERROR_CANCELLED;
    }
    for (int i = 0; i < 10; ++i) {
        if (host->is_cancelled(host) && !has("cancel-ignored")) {
            host->set_error(host, nullptr, "stopped");
            return has("cancel-code") ? ELVIS_ERROR_FAILED : ELVIS_ERROR_CANCELLED;
        }
    }
    data.host = host;
    const elvis_result result = read(host, path, data);
    if (result != ELVIS_OK) {
        return result;
    }
    const int number = n_opened++;
    if (n_open++ > 0 && has("open-race")) {
        data.scale *= 2;
    }
    if (has("open-race")) {
        ::usleep(1000); // so that two meet
    }
    if (has("leak")) {
        data.lost = new char[10000];
    }
    if (has("changing")) {
        data.name += std::to_string(number);
    }
    if (has("source-changing")) {
        data.scale *= 1 + number;
    }
    return ELVIS_OK;
}

/** Another thread inside at the same time is a mistake only for the defects that say so. */
class Inside {
public:
    explicit Inside(bool is_defective) : m_is_defective(is_defective) {
        if (m_is_defective) {
            m_others = n_inside++;
            ::usleep(100);
        }
    }
    ~Inside() {
        if (m_is_defective) {
            --n_inside;
        }
    }
    bool is_disturbed() const { return m_is_defective && m_others > 0; }

private:
    bool m_is_defective;
    int m_others = 0;
};

inline void position(std::uint64_t element, const double* xi, double* x) {
    x[0] = 2 * static_cast<double>(element) + xi[0];
    x[1] = xi[1] + 0.2 * xi[0] * xi[0];
    x[2] = xi[2] + 0.1 * xi[0] * xi[0] * xi[1];
}

inline double value(const Data& data, const double* xi) { return data.scale * (xi[0] * xi[0] + xi[1] * xi[2]); }

inline elvis_result probe(const elvis_host*, const char* path, std::uint32_t* confidence) {
    *confidence = is_ours(path) ? 100 : 0;
    return ELVIS_OK;
}

/** The table of the converter interface. */
const elvis_converter* converter();

} // namespace defective
