#include <apps/elvis/commands.hpp>

#include <core/base/error.hpp>

#include <plugin_templates.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string_view>

namespace elvis::commands {

namespace fs = std::filesystem;

namespace {

struct NewPluginArguments {
    std::string name;
    std::string kind = "runtime";
    std::string output;
    std::string id;
};

/** The name is that of a folder, a library, a C++ namespace and the prefix of GLSL functions at once. */
void check_name(const std::string& name) {
    const bool characters = std::all_of(name.begin(), name.end(),
                                        [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; });
    if (name.empty() || !characters || name.front() < 'a' || name.front() > 'z' || name.back() == '_' ||
        name.find("__") != std::string::npos) {
        throw UsageError(name,
                         "cannot be a plugin's name, which has lower-case letters, digits and single '_', as in my_solver");
    }
    if (name == "elvis" || name == "core" || name == "gl" || name == "std" || name.rfind("gl_", 0) == 0) {
        throw UsageError(name, "is taken; name the plugin after your solver");
    }
}

std::string replace_all(std::string text, std::string_view mark, const std::string& by) {
    for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + by.size())) {
        text.replace(at, mark.size(), by);
    }
    return text;
}

void write_file(const fs::path& path, const std::string& text) {
    fs::create_directories(path.parent_path());
    std::ofstream file(path, std::ios::binary);
    file << text;
    if (!file.flush()) {
        throw Error(path.string(), "cannot be written");
    }
}

/** Writes the files of template `kind` below `folder`. */
void write_template(const NewPluginArguments& arguments, const std::string& id, std::string_view kind, const fs::path& folder) {
    const std::string prefix = std::string(kind) + "/";
    for (const auto& file : plugin_templates::files) {
        std::string name = file.name;
        if (name.compare(0, prefix.size(), prefix) != 0) {
            continue;
        }
        name.erase(0, prefix.size());
        // A file of that name here would make git ignore templates.
        const fs::path path = folder / (name == "gitignore" ? ".gitignore" : name);
        write_file(path, replace_all(replace_all(file.text, "@NAME@", arguments.name), "@ID@", id));
    }
}

/** What to put before commands so that CMake finds the ElVis that this program belongs to; empty if it does by itself. */
std::string where_elvis_is() {
    std::error_code ignored;
    const fs::path folder = fs::read_symlink("/proc/self/exe", ignored).parent_path();
    const char* path = std::getenv("PATH");
    const std::string list = ":" + std::string(path ? path : "") + ":";
    return list.find(":" + folder.string() + ":") != std::string::npos
               ? std::string()
               : "CMAKE_PREFIX_PATH=" + folder.parent_path().string() + " ";
}

void run_new_plugin(const NewPluginArguments& arguments) {
    check_name(arguments.name);
    const std::string id = arguments.id.empty() ? "org.example." + arguments.name : arguments.id;
    const fs::path folder = arguments.output.empty() ? fs::path(arguments.name) : fs::path(arguments.output);
    if (std::error_code ignored; fs::exists(folder, ignored) && !fs::is_empty(folder, ignored)) {
        throw Error(folder.string(), "exists and is not empty; nothing was written");
    }
    write_template(arguments, id, "common", folder);
    write_template(arguments, id, arguments.kind, folder);
    std::printf(
        "%s: a %s plugin. Build it, test it and draw %s/build/picture.png:\n    cd %s && %scmake --workflow --preset default\n",
        folder.c_str(), arguments.kind.c_str(), folder.c_str(), folder.c_str(), where_elvis_is().c_str());
}

} // namespace

void add_new_plugin(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("new-plugin", "Write a small plugin project that builds, passes its tests and draws");
    auto a = std::make_shared<NewPluginArguments>();
    command->add_option("name", a->name, "Name of the plugin: a lower-case identifier such as my_solver")->required();
    command->add_option("--kind", a->kind, "runtime (draws volumes in their own basis) or converter (for the native volume)")
        ->check(CLI::IsMember({"runtime", "converter"}))
        ->capture_default_str();
    command->add_option("--output", a->output, "Folder to write, new or empty (default: NAME)");
    command->add_option("--id", a->id, "Id of the plugin, reverse-domain style (default: org.example.NAME)");
    command->callback([a] { run_new_plugin(*a); });
}

} // namespace elvis::commands
