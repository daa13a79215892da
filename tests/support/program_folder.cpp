#include <tests/support/program_folder.hpp>

#include <sys/wait.h>

#include <cstdlib>

namespace elvis::test {

Outcome ProgramFolder::run(const std::string& arguments, const std::string& environment) const {
    const std::string command =
        "cd '" + path().string() + "' && " + environment + " '" ELVIS_PROGRAM "' " + arguments + " >out.txt 2>err.txt";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read("out.txt"), read("err.txt")};
}

} // namespace elvis::test
