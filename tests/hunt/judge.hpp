/**
 * @file judge.hpp
 * A picture of the program against the oracle, pixel by pixel.
 */
#pragma once

#include "tolerances.hpp"
#include <core/oracle/scene/scene_oracle.hpp>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace elvis::hunt {

/** Which colour the flags around a pixel ask for. */
struct LineColor {
    /** There is a line, of which the colour is not known here if it is the colour map's. */
    bool is_line = false;
    std::optional<Color> color{};
};

/** What a picture has at a pixel, or would have. */
struct Shown {
    Color color{};
    bool is_hit = false;
    double value = 0, depth = 0;
    oracle::Vector normal = oracle::Vector::Zero();
    std::int64_t element = -1;
    std::uint32_t flags = 0;
    LineColor line{};
};

enum class Verdict {
    right,
    flagged_right, ///< flagged, rightly or not, and within the tolerances
    false_alarm,   ///< that, and rounding would not change the answer
    flagged_wrong,
    near,       ///< wrong without a flag: the answer of a scene that rounding could take for this one
    far,        ///< wrong without a flag, and no such answer
    undecidable ///< the oracle cannot tell
};

/** A pixel that is wrong without a flag. */
struct Finding {
    std::uint32_t row = 0, column = 0;
    Verdict verdict = Verdict::far;
    /** Bits of buffer. */
    unsigned wrong = 0;
    std::string shown, truth;
};

/** Sums over pixels. */
struct Tally {
    std::uint64_t pixels = 0, hits = 0, flagged = 0, flagged_wrong = 0, near = 0, far = 0, undecidable = 0;
    /** Pixels of which flags of contours, or of mesh lines, were judged. */
    std::uint64_t lines = 0;
    /** By bit: false alarms of flags, silent errors of buffers. */
    std::map<std::uint32_t, std::uint64_t> false_alarms, silent;
    double render_seconds = 0, oracle_seconds = 0;

    std::uint64_t all_false_alarms = 0;
    Tally& operator+=(const Tally& other);
};

struct Judgement {
    Tally tally;
    /** The first ones, `far` ones before others. */
    std::vector<Finding> findings;
    Judgement& operator+=(Judgement&& other);
};

/** Of the oracle, for a pixel. */
struct Answer {
    oracle::PixelAnswer pixel;
    bool is_failure = false;
};

/** Judges frames of one request. */
class Judge {
public:
    /** `reason` tells if the oracle does not know the scene: then it judges nothing. */
    Judge(oracle::SceneVolume& volume, const FrameRequest& request, std::string& reason);
    /** Of a smaller picture whose rays are rays of a larger one (twins.hpp), with the answers that are drawn for that. */
    Judge(const Judge& larger, const FrameRequest& smaller);

    /** Answers of all pixels, by all cores; kept for all frames. */
    void draw();
    Judgement judge(const Frame& frame, Precision precision) const;
    double seconds() const { return m_seconds; }

private:
    friend class PixelJudge;
    const FrameRequest& m_request;
    std::vector<std::shared_ptr<oracle::SceneOracle>> m_oracles;
    std::unordered_map<std::int64_t, std::size_t> m_elements;
    std::vector<Answer> m_answers;
    double m_seconds = 0;
};

} // namespace elvis::hunt
