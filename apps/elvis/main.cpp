#include "commands.hpp"

#include <core/base/error.hpp>

#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
    CLI::App app{"ElVis, the Element Visualizer: pixel-exact pictures of high-order finite element fields"};
    app.require_subcommand(1);

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    } catch (const elvis::UsageError& error) {
        std::fprintf(stderr, "elvis: %s\n", error.what());
        return 2;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "elvis: %s\n", error.what());
        return 1;
    }
    return 0;
}
