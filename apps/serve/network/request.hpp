/**
 * @file request.hpp
 * What an address asks for, whatever a proxy has put before it.
 */
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace elvis::serve {

struct Address {
    /** The last part of the path: prefixes of proxies do not matter. */
    std::string name;
    std::map<std::string, std::string> parameters;

    std::string parameter(const std::string& key) const;
};

/** Of the target of a request. Parameters are taken as they are, without escapes: ours have none. */
Address address_of(std::string_view target);

/** Whether a page of that origin ("http://host:port") was sent by a server that is called `host`. */
bool is_origin_of(std::string_view origin, std::string_view host);

} // namespace elvis::serve
