#include <core/demand/elements_in_blocks.hpp>

#include <core/base/in_parts.hpp>

#include <atomic>

namespace elvis {

void in_blocks(Background& background, std::uint64_t n_blocks, const TaskControl* control,
               const std::function<void(std::uint64_t block)>& work) {
    in_parts(
        background, n_blocks, 1, [&](std::uint64_t block, std::uint64_t) { work(block); },
        [control] {
            if (control != nullptr) {
                control->check();
            }
        });
}

std::vector<std::uint64_t>
elements_in_blocks(Background& background, std::uint64_t n_blocks, std::uint64_t most, const TaskControl* control,
                   const std::function<void(std::uint64_t block, std::vector<std::uint64_t>& found)>& find) {
    std::vector<std::vector<std::uint64_t>> of_blocks(n_blocks);
    std::atomic<std::uint64_t> n_elements{0};
    in_blocks(background, n_blocks, control, [&](std::uint64_t block) {
        if (n_elements <= most) {
            find(block, of_blocks[block]);
            n_elements += of_blocks[block].size();
        }
    });
    if (n_elements > most) {
        throw TooManyElements{};
    }
    std::vector<std::uint64_t> all;
    all.reserve(n_elements);
    for (const std::vector<std::uint64_t>& own : of_blocks) {
        all.insert(all.end(), own.begin(), own.end());
    }
    return all;
}

} // namespace elvis
