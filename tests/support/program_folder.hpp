/**
 * @file program_folder.hpp
 * The program as a user runs it.
 */
#pragma once

#include <tests/support/files.hpp>

#include <string>

namespace elvis::test {

struct Outcome {
    /** Of the exit; -1 of what a signal ended. */
    int status = -1;
    std::string out;
    std::string err;
};

/** A folder in which commands are run. */
class ProgramFolder : public TemporaryFolder {
public:
    /** `elvis ARGUMENTS`, with an environment such as "NAME=value". */
    Outcome run(const std::string& arguments, const std::string& environment = "") const;
    /** All of a file in it. */
    std::string read(const std::string& name) const { return read_file(path(name)); }
};

} // namespace elvis::test
