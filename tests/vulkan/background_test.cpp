#include <core/base/in_parts.hpp>

#include <catch2/catch.hpp>

#include <atomic>
#include <chrono>
#include <future>
#include <stdexcept>
#include <thread>

using namespace elvis;

TEST_CASE("Work in the background is done once, and its error reaches everybody who waits") {
    std::atomic<int> n_done{0};
    Background background(3);
    std::vector<std::shared_ptr<Background::Work>> all;
    all.reserve(100);
    for (int i = 0; i < 100; ++i) {
        all.push_back(background.hand_over([&n_done] { ++n_done; }));
    }
    for (const auto& work : all) {
        work->wait();
        work->wait();
    }
    REQUIRE(n_done == 100);
    const auto failing = background.hand_over([] { throw std::runtime_error("why"); });
    REQUIRE_THROWS_WITH(failing->wait(), "why");
    REQUIRE_THROWS_WITH(failing->wait(), "why");
    failing->drop();
}

TEST_CASE("Who waits for work that nobody has begun does it") {
    Background background(1);
    std::promise<void> may_end;
    const auto blocking = background.hand_over([&may_end] { may_end.get_future().wait(); });
    int n_done = 0;
    const auto needed = background.hand_over([&n_done] { ++n_done; });
    const auto dropped = background.hand_over([&n_done] { n_done += 10; });
    needed->wait();
    dropped->drop();
    dropped->wait();
    REQUIRE(n_done == 1);
    may_end.set_value();
    blocking->wait();
}

TEST_CASE("Nothing is at work once the background has finished") {
    Background background(2);
    std::atomic<int> n_done{0};
    for (int i = 0; i < 50; ++i) {
        background.hand_over([&n_done] {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            ++n_done;
        });
    }
    const auto failing = background.hand_over([] { throw std::runtime_error("why"); });
    background.finish();
    REQUIRE(n_done == 50);
    REQUIRE_THROWS_WITH(failing->wait(), "why");
}

TEST_CASE("What is left in the background when it ends can still be waited for") {
    std::shared_ptr<Background::Work> left;
    int n_done = 0;
    std::promise<void> may_end;
    {
        Background background(1);
        background.hand_over([&may_end] { may_end.get_future().wait(); });
        left = background.hand_over([&n_done] { ++n_done; });
        may_end.set_value();
    }
    left->wait();
    REQUIRE(n_done == 1);
}

TEST_CASE("Work in parts does each item once, and what a part throws is thrown") {
    Background background(3);
    std::vector<std::atomic<int>> done(1000);
    std::atomic<bool> is_too_large{false};
    in_parts(background, done.size(), 64, [&](std::uint64_t first, std::uint64_t count) {
        is_too_large = is_too_large || count > 64;
        for (std::uint64_t item = first; item < first + count; ++item) {
            ++done[item];
        }
    });
    CHECK(std::ranges::all_of(done, [](const std::atomic<int>& times) { return times == 1; }));
    CHECK_FALSE(is_too_large);
    in_parts(background, 0, 64, [](std::uint64_t, std::uint64_t) { FAIL(); });
    const auto failing = [](std::uint64_t first, std::uint64_t) {
        if (first >= 500) {
            throw std::runtime_error("part " + std::to_string(first));
        }
    };
    CHECK_THROWS_WITH(in_parts(background, done.size(), 100, failing), "part 500");
    const auto stop = [] { throw std::runtime_error("stopped"); };
    CHECK_THROWS_WITH(in_parts(
                          background, done.size(), 100, [](std::uint64_t, std::uint64_t) {}, stop),
                      "stopped");
}
