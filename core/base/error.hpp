/**
 * @file error.hpp
 * The one error type of the core, and the place where it becomes a message.
 */
#pragma once

#include <stdexcept>
#include <string>

namespace elvis {

/**
 * Something that the user, a file, a plugin or a device did wrong. `place` names where (file, scene key, plugin, line); `cause`
 * says what is wrong and, where it helps, what to do. Our own mistakes are assertions, not errors.
 */
class Error : public std::runtime_error {
public:
    Error(std::string place, std::string cause);
    explicit Error(std::string cause);

    const std::string& place() const { return m_place; }
    const std::string& cause() const { return m_cause; }

private:
    std::string m_place;
    std::string m_cause;
};

/** Wrong usage of the command line: exit status 2 instead of 1. */
class UsageError : public Error {
public:
    using Error::Error;
};

/** The user asked to stop. */
class Cancelled : public Error {
public:
    Cancelled();
};

} // namespace elvis
