/**
 * @file error_of.hpp
 * Errors that tests expect.
 */
#pragma once

#include <core/base/error.hpp>

#include <catch2/catch.hpp>

#include <string>

namespace elvis::test {

/** Text of the Error that a call throws; fails the test if it throws none. */
template <class Call> std::string error_of(Call&& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    FAIL("no error was thrown");
    return {};
}

} // namespace elvis::test
