#include "film.hpp"

#include <core/base/error.hpp>
#include <cstdio>

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <spawn.h>
#include <sstream>
#include <system_error>
#include <vector>

extern char** environ;

namespace elvis::commands {

namespace {

constexpr const char* program = "ffmpeg";

/** Runs ffmpeg without a shell: names may hold anything. Returns its exit status. */
int run_film_maker(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), program);
    std::vector<char*> pointers;
    for (std::string& argument : arguments) {
        pointers.push_back(argument.data());
    }
    pointers.push_back(nullptr);
    pid_t process = 0;
    if (const int failure = ::posix_spawnp(&process, program, nullptr, nullptr, pointers.data(), environ); failure != 0) {
        throw Error(program, "cannot be started: " + std::system_category().message(failure));
    }
    int status = 0;
    while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

} // namespace

std::string frame_name(std::uint32_t frame) {
    char name[32];
    std::snprintf(name, sizeof name, "frame_%04u.png", frame);
    return name;
}

void require_film_maker() {
    const char* const path = std::getenv("PATH");
    std::istringstream folders(path != nullptr ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        if (::access((std::filesystem::path(folder) / program).c_str(), X_OK) == 0) {
            return;
        }
    }
    throw Error("--film",
                "needs ffmpeg, which is not on the PATH; without --film the numbered pictures are drawn, of which any "
                "film maker can make one");
}

void make_film(const std::filesystem::path& pattern, double frames_a_second, const std::filesystem::path& film) {
    // With the film's own ending, by which ffmpeg knows what is wanted.
    const std::filesystem::path temporary =
        film.parent_path() / (".part-" + std::to_string(::getpid()) + "-" + film.filename().string());
    std::ostringstream rate;
    rate.precision(12);
    rate << frames_a_second;
    const int status = run_film_maker({"-y", "-nostdin", "-loglevel", "error", "-framerate", rate.str(), "-i", pattern.string(),
                                       // Most players want even sizes and colours at half the resolution.
                                       "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", temporary.string()});
    std::error_code failure;
    if (status == 0) {
        std::filesystem::rename(temporary, film, failure);
        if (!failure) {
            return;
        }
    }
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw Error(film.string(), failure
                                   ? "cannot be written: " + failure.message()
                                   : std::string("ffmpeg could not make it; the pictures are beside, as ") + pattern.string());
}

} // namespace elvis::commands
