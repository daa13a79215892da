/**
 * @file integrated.hpp
 * Integrals over volumes that the generator describes.
 */
#pragma once

#include <core/integrate/integral.hpp>
#include <tests/support/test_volumes.hpp>

#include <string>

namespace elvis::test {

/** A generated volume, and its file. */
class GeneratedVolume {
public:
    /** `keys`: of the generator's description, but for its version. */
    explicit GeneratedVolume(const std::string& keys) : m_file("integrated.h5") {
        oracle::generate(R"({"generator": 1, )" + keys + "}", m_file.path());
        m_volume.emplace(oracle::open_volume(m_file.path()));
    }
    const RuntimeVolume& operator*() const { return *m_volume; }

private:
    TemporaryFile m_file;
    std::optional<RuntimeVolume> m_volume;
};

inline Integral integral_of(const GeneratedVolume& volume, const IntegralRequest& request) {
    const TaskControl control;
    return integrate(*volume, request, control);
}

inline IntegralRequest over(IntegralRequest::Domain domain, const std::string& field, bool is_flux = false) {
    IntegralRequest request;
    request.domain = domain;
    request.field = field;
    request.is_flux = is_flux;
    return request;
}

inline std::string shape_key(const std::string& shape) { return R"("shape": ")" + shape + R"(", )"; }

} // namespace elvis::test
