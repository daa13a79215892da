// Which picture comes next, with a clock and a device that are made up.
#include <apps/elvis/view/model/frame_schedule.hpp>

#include <catch2/catch.hpp>

#include <algorithm>

using namespace elvis::view;

namespace {

using Stage = FrameStage;

/** Takes `fixed` milliseconds and so many for all pixels of a picture of full size. */
struct MadeUp {
    double fixed = 2, all = 1000;
    /** Of lines, at any size. */
    double lines = 0;
    FrameSchedule::Time now{};
    FrameSchedule schedule{10};

    void wait(double milliseconds) {
        now +=
            std::chrono::duration_cast<FrameSchedule::Clock::duration>(std::chrono::duration<double, std::milli>(milliseconds));
    }
    /** Draws what is wanted, which has lines to refine; returns how long that took, nothing if nothing is wanted. */
    std::optional<double> draw(bool has_lines = true) {
        const auto step = schedule.next(now);
        if (!step) {
            return {};
        }
        const double milliseconds = fixed + (has_lines && step->with_lines ? lines : 0) +
                                    all / (step->divisor * step->divisor) * (step->stage == Stage::exact && has_lines ? 3 : 1);
        wait(milliseconds);
        schedule.drawn(*step, has_lines, milliseconds);
        return milliseconds;
    }
};

} // namespace

TEST_CASE("while things move ten frames a second are drawn, as large as that allows") {
    for (const double all : {5.0, 60.0, 300.0, 1000.0, 20000.0}) {
        MadeUp made;
        made.all = all;
        double last = 0;
        for (int frame = 0; frame < 12; ++frame) {
            made.schedule.touch(made.now);
            last = made.draw().value();
        }
        CAPTURE(all, made.schedule.moving_divisor(), last);
        CHECK(last <= 100);
        // One size more would be too slow, or near to it.
        CHECK((made.schedule.moving_divisor() == 1 || last > 15));
        CHECK(made.schedule.shown() == (made.schedule.moving_divisor() == 1 ? Stage::full : Stage::moving));
        // And it stays at that size.
        const std::uint32_t divisor = made.schedule.moving_divisor();
        for (int frame = 0; frame < 20; ++frame) {
            made.schedule.touch(made.now);
            made.draw();
            CHECK(made.schedule.moving_divisor() == divisor);
        }
    }
}

TEST_CASE("a picture that was slow for another reason leaves those after it small for a second or two at most") {
    MadeUp made;
    made.all = 60;
    const auto move = [&](int n_frames) {
        for (int frame = 0; frame < n_frames; ++frame) {
            made.schedule.touch(made.now);
            made.draw();
        }
    };
    move(12);
    REQUIRE(made.schedule.moving_divisor() == 1);
    made.all = 600;
    move(2);
    made.all = 60;
    move(30);
    CHECK(made.schedule.moving_divisor() == 1);
}

TEST_CASE("of times that are nearly the same for all sizes the largest is found") {
    // Milliseconds at a budget of 100: of 2 by 2 pixels as one 50, of all of them 88; the second time after a disturbance.
    for (const bool is_disturbed : {false, true}) {
        MadeUp made;
        made.fixed = 37;
        made.all = 51;
        const auto move = [&](int n_frames) {
            for (int frame = 0; frame < n_frames; ++frame) {
                made.schedule.touch(made.now);
                made.draw();
            }
        };
        move(is_disturbed ? 3 : 0);
        made.fixed = is_disturbed ? 300 : made.fixed;
        move(is_disturbed ? 5 : 0);
        made.fixed = 37;
        move(50);
        CAPTURE(is_disturbed);
        CHECK(made.schedule.moving_divisor() == 1);
    }
}

TEST_CASE("a larger size that is too slow is tried ever more seldom") {
    MadeUp made;
    made.fixed = 0;
    made.all = 220; // Two by two as one: 55. There is no size in between.
    int n_slow = 0, n_late = 0;
    for (int frame = 0; frame < 1000; ++frame) {
        made.schedule.touch(made.now);
        const bool is_slow = made.draw().value() > 100;
        n_slow += is_slow ? 1 : 0;
        n_late += is_slow && frame >= 500 ? 1 : 0;
    }
    // Two pictures a trial.
    CHECK(n_slow <= 14);
    CHECK(n_late <= 4);
    CHECK(made.schedule.moving_divisor() == 2);
}

TEST_CASE("the first picture of a size may take longer than the others") {
    MadeUp made;
    made.fixed = 37;
    made.all = 51;
    std::uint32_t last = 0;
    for (int frame = 0; frame < 30; ++frame) {
        made.schedule.touch(made.now);
        const std::uint32_t divisor = made.schedule.next(made.now)->divisor;
        made.fixed = divisor == last || frame == 0 ? 37 : 150;
        last = divisor;
        made.draw();
    }
    CHECK(made.schedule.moving_divisor() == 1);
}

TEST_CASE("one picture that is slow by chance does not make the next ones small") {
    MadeUp made;
    made.all = 60;
    for (int frame = 0; frame < 60; ++frame) {
        made.fixed = frame % 10 == 9 ? 120 : 2;
        made.schedule.touch(made.now);
        made.draw();
        CHECK((frame < 12 || made.schedule.moving_divisor() == 1));
    }
}

TEST_CASE("time that no pixel takes is not mended by fewer pixels") {
    for (const double fixed : {60.0, 150.0}) {
        MadeUp made;
        made.fixed = fixed;
        made.all = 400;
        // Once at rest, so that it is known what all pixels take.
        while (made.draw()) {
        }
        double last = 0;
        for (int frame = 0; frame < 12; ++frame) {
            made.schedule.touch(made.now);
            last = made.draw().value();
        }
        CAPTURE(fixed, made.schedule.moving_divisor(), last);
        CHECK(last <= std::max(100.0, 1.35 * fixed));
        // 400 / 16 and 400 / 9 milliseconds of pixels, or one size less.
        CHECK(made.schedule.moving_divisor() <= 6);
    }
}

TEST_CASE("lines that take too long are left out while things move") {
    MadeUp made;
    made.lines = 300;
    double last = 0;
    for (int round = 0; round < 3; ++round) {
        for (int frame = 0; frame < 12; ++frame) {
            made.schedule.touch(made.now);
            last = made.draw().value();
        }
        CHECK(last <= 100);
        CHECK(made.schedule.moving_divisor() <= 4);
        made.schedule.touch(made.now);
        CHECK_FALSE(made.schedule.next(made.now)->with_lines);
        made.schedule.release();
        made.draw();
        CHECK(made.schedule.next(made.now)->with_lines);
        while (made.draw()) {
        }
        CHECK(made.schedule.shown() == Stage::exact);
    }
    // Something else is opened.
    made.lines = 2;
    made.all = 100;
    for (int frame = 0; frame < 12; ++frame) {
        made.schedule.change();
        while (made.draw()) {
        }
    }
    made.schedule.touch(made.now);
    CHECK(made.schedule.next(made.now)->with_lines);
}

TEST_CASE("when the hand rests all pixels come, then exact ones, then nothing") {
    MadeUp made;
    made.schedule.touch(made.now);
    made.draw();
    CHECK(made.schedule.shown() == Stage::moving);
    // The hand is still there, and has not moved.
    CHECK_FALSE(made.draw());
    made.wait(250);
    made.draw();
    CHECK(made.schedule.shown() == Stage::full);
    made.draw();
    CHECK(made.schedule.shown() == Stage::exact);
    CHECK_FALSE(made.draw());
    // Let go: no need to wait.
    made.schedule.touch(made.now);
    CHECK(made.schedule.shown() == Stage::none);
    made.draw();
    made.schedule.release();
    made.draw();
    CHECK(made.schedule.shown() == Stage::full);
    // Something typed in: something to look at until all pixels are there.
    made.schedule.change();
    made.draw();
    CHECK(made.schedule.shown() == Stage::moving);
    made.draw();
    CHECK(made.schedule.shown() == Stage::full);
}

TEST_CASE("what is quick comes with all pixels at once") {
    MadeUp made;
    made.all = 30;
    for (int frame = 0; frame < 3; ++frame) {
        made.schedule.change();
        made.draw();
        made.draw();
        made.draw();
    }
    made.schedule.change();
    made.draw();
    CHECK(made.schedule.shown() == Stage::full);
    made.draw();
    CHECK(made.schedule.shown() == Stage::exact);
}

TEST_CASE("surfaces without lines are exact when all pixels are drawn") {
    MadeUp made;
    made.schedule.touch(made.now);
    made.draw(false);
    CHECK(made.schedule.shown() == Stage::moving);
    made.schedule.release();
    made.draw(false);
    CHECK(made.schedule.shown() == Stage::exact);
    CHECK_FALSE(made.draw(false));
}

TEST_CASE("a large picture is outdated by the next movement, a small one is not") {
    MadeUp made;
    made.draw();
    const auto full = made.schedule.next(made.now);
    REQUIRE(full);
    CHECK(full->stage == Stage::full);
    CHECK_FALSE(made.schedule.is_outdated(*full, made.now));
    made.schedule.touch(made.now);
    CHECK(made.schedule.is_outdated(*full, made.now));
    const auto moving = made.schedule.next(made.now);
    REQUIRE(moving);
    CHECK(moving->stage == Stage::moving);
    made.schedule.touch(made.now);
    CHECK_FALSE(made.schedule.is_outdated(*moving, made.now));
    made.schedule.release();
    CHECK(made.schedule.is_outdated(*moving, made.now));
}

TEST_CASE("where all pixels are quick, a movement does not cancel its own pictures") {
    FrameSchedule schedule;
    FrameSchedule::Time now{};
    for (int i = 0; i < 100 && schedule.moving_divisor() > 1; ++i) {
        schedule.touch(now);
        const auto step = schedule.next(now);
        REQUIRE(step);
        const auto before = std::ranges::find(FrameSchedule::divisors, schedule.moving_divisor());
        schedule.drawn(*step, true, 1);
        // One size at a time.
        CHECK(before - std::ranges::find(FrameSchedule::divisors, schedule.moving_divisor()) <= 1);
        now += std::chrono::milliseconds(16);
    }
    REQUIRE(schedule.moving_divisor() == 1);
    schedule.touch(now);
    const auto full = schedule.next(now);
    REQUIRE(full);
    CHECK(full->stage == Stage::full);
    schedule.touch(now);
    CHECK_FALSE(schedule.is_outdated(*full, now));
    schedule.release();
    CHECK(schedule.is_outdated(*full, now));
}
