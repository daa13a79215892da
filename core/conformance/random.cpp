#include <core/conformance/random.hpp>

namespace elvis::conformance {

std::uint64_t Random::next() {
    m_state += 0x9e3779b97f4a7c15u;
    std::uint64_t z = m_state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

std::string random_bytes(std::size_t count, std::uint64_t seed) {
    Random random(seed);
    std::string bytes(count, '\0');
    for (char& byte : bytes) {
        byte = static_cast<char>(random.next() & 0xffu);
    }
    return bytes;
}

} // namespace elvis::conformance
