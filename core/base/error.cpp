#include <core/base/error.hpp>

#include <utility>

namespace elvis {

Error::Error(std::string place, std::string cause)
    : std::runtime_error(place.empty() ? cause : place + ": " + cause), m_place(std::move(place)), m_cause(std::move(cause)) {}

Error::Error(std::string cause) : Error(std::string{}, std::move(cause)) {}

Cancelled::Cancelled() : Error("cancelled") {}

} // namespace elvis
