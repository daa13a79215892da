#include "request.hpp"

#include <algorithm>

namespace elvis::serve {

std::string Address::parameter(const std::string& key) const {
    const auto found = parameters.find(key);
    return found == parameters.end() ? std::string() : found->second;
}

Address address_of(std::string_view target) {
    Address address;
    const std::size_t question = std::min(target.find('?'), target.size());
    const std::string_view path = target.substr(0, question);
    address.name = path.substr(path.rfind('/') + 1); // npos + 1 is 0
    std::string_view rest = target.substr(std::min(question + 1, target.size()));
    while (!rest.empty()) {
        const std::string_view part = rest.substr(0, rest.find('&'));
        const std::size_t equals = std::min(part.find('='), part.size());
        address.parameters.emplace(part.substr(0, equals), part.substr(std::min(equals + 1, part.size())));
        rest.remove_prefix(std::min(part.size() + 1, rest.size()));
    }
    return address;
}

bool is_origin_of(std::string_view origin, std::string_view host) {
    for (const std::string_view scheme : {"http://", "https://"}) {
        if (origin.starts_with(scheme) && origin.substr(scheme.size()) == host) {
            return true;
        }
    }
    return false;
}

} // namespace elvis::serve
