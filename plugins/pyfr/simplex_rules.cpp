#include "simplex_rules.hpp"

#include <algorithm>
#include <string_view>

namespace elvis_pyfr {

namespace {

enum class Symmetry { centre, three, six, four, six_edges, twelve, twenty_four };

/**
 * Points that the symmetries of the simplex turn into each other, in the order of PyFR's tables. Letters stand for the orbit's
 * numbers, as many of them a point as the simplex has dimensions.
 */
constexpr std::string_view pattern(Symmetry symmetry, std::size_t dimension) {
    switch (symmetry) {
    case Symmetry::three:
        return "abbaaa";
    case Symmetry::six:
        return "abcbbcaccaba";
    case Symmetry::four:
        return "aabbaaabaaaa";
    case Symmetry::six_edges:
        return "bababbbaaabaaabbba";
    case Symmetry::twelve:
        return "abcabbbbacabbcababcbabcbbbcbaccbbacb";
    case Symmetry::twenty_four:
        return "abcbcabaccadcabdaccbdcdadbcabddabcbadbaadccdbbdcadbbdabaddcaacdacbbcddcb";
    case Symmetry::centre:
        break;
    }
    return std::string_view("aaa").substr(0, dimension);
}

struct Orbit {
    Symmetry symmetry;
    std::vector<double> numbers;
};

struct Rule {
    std::string_view kind;
    std::string_view name;
    std::size_t n_points;
    std::vector<Orbit> orbits;
};

/**
 * Source: PyFR, pyfr/quadrules/tri and tet, as of 2.1 (BSD-3, LICENSE.PyFR beside this file). The rules of Williams and Shunn
 * and of Shunn and Ham integrate polynomials of the degrees in the tables' names.
 */
const std::vector<Rule>& rules() {
    using enum Symmetry;
    static const std::vector<Rule> all = {
        {"tri", "williams-shunn", 3, {{three, {-0.666666666666666, 0.333333333333332}}}},
        {"tri",
         "williams-shunn",
         6,
         {{three, {-0.81684757298044, 0.63369514596088}}, {three, {-0.108103018168072, -0.783793963663856}}}},
        {"tri",
         "williams-shunn",
         10,
         {{centre, {-0.333333333333333}},
          {three, {-0.888871894660414, 0.777743789320828}},
          {six, {0.268421495491446, -0.408932576528214, -0.859488918963232}}}},
        {"tri",
         "williams-shunn",
         15,
         {{three, {-0.928258244608532, 0.856516489217064}},
          {three, {-0.516541208464066, 0.033082416928132}},
          {three, {-0.051382424445842, -0.897235151108316}},
          {six, {0.502367262212968, -0.5969922362364, -0.905375025976568}}}},
        {"tri",
         "williams-shunn",
         21,
         {{three, {-0.943774095634672, 0.887548191269344}},
          {three, {-0.645721803061366, 0.291443606122732}},
          {three, {-0.188982808265134, -0.622034383469732}},
          {six, {0.635801960056998, -0.702868375458226, -0.932933584598772}},
          {six, {0.209957823550266, -0.285607402768638, -0.924350420781628}}}},
        {"tri",
         "williams-shunn",
         28,
         {{centre, {-0.333333333333333}},
          {three, {-0.960045625755614, 0.920091251511228}},
          {three, {-0.736556464940004, 0.473112929880008}},
          {three, {-0.029729306413078, -0.940541387173844}},
          {six, {0.7358224202359, -0.784096036307978, -0.951726383927922}},
          {six, {0.401745140761446, -0.458318454156866, -0.94342668660458}},
          {six, {0.073309368412276, -0.366900802310766, -0.70640856610151}}}},
        {"tri",
         "williams-shunn",
         36,
         {{three, {-0.95765715444107, 0.91531430888214}},
          {three, {-0.798831205208224, 0.597662410416448}},
          {three, {-0.457923384576136, -0.084153230847728}},
          {three, {-0.119617483192336, -0.760765033615328}},
          {six, {0.759959282854462, -0.963486641850504, -0.796472641003958}},
          {six, {0.165124045727344, -0.211933456660026, -0.953190589067318}},
          {six, {0.503061229085564, -0.547508938181542, -0.955552290904022}},
          {six, {0.27147436652621, -0.501841544757336, -0.769632821768874}}}},
        {"tri",
         "williams-shunn",
         45,
         {{three, {-0.895845867331362, 0.791691734662724}},
          {three, {-0.772586942778008, 0.545173885556016}},
          {three, {-0.565662308452164, 0.131324616904328}},
          {three, {-0.227854451277354, -0.544291097445292}},
          {three, {-0.02014813417346, -0.95970373165308}},
          {six, {0.669376181231556, -0.703503756777164, -0.965872424454392}},
          {six, {0.414495985308496, -0.57957674232286, -0.834919242985636}},
          {six, {0.925803833285858, -0.92588151521622, -0.999922318069638}},
          {six, {0.348012222825796, -0.38207975901364, -0.965932463812156}},
          {six, {0.08389791764566, -0.279351646321358, -0.804546271324302}}}},
        {"tri", "alpha-opt", 3, {{three, {-1.0, 1.0}}}},
        {"tri", "alpha-opt", 6, {{three, {-1.0, 1.0}}, {three, {0.0, -1.0}}}},
        {"tri",
         "alpha-opt",
         10,
         {{centre, {-0.3333333333333333}}, {three, {-1.0, 1.0}}, {six, {0.447213595499958, -0.447213595499958, -1.0}}}},
        {"tri",
         "alpha-opt",
         15,
         {{three, {-1.0, 1.0}},
          {three, {-0.551583572090994, 0.103167144181987}},
          {three, {0.0, -1.0}},
          {six, {0.654653670707977, -0.654653670707977, -1.0}}}},
        {"tri",
         "alpha-opt",
         21,
         {{three, {-1.0, 1.0}},
          {three, {-0.6844725145019088, 0.3689450290038176}},
          {three, {-0.1712454773320746, -0.6575090453358508}},
          {six, {0.765055323929465, -0.765055323929465, -1.0}},
          {six, {0.2852315164806452, -0.2852315164806452, -1.0}}}},
        {"tri",
         "alpha-opt",
         28,
         {{centre, {-0.3333333333333333}},
          {three, {-1.0, 1.0}},
          {three, {-0.7695164961934418, 0.5390329923868836}},
          {three, {0.0, -1.0}},
          {six, {0.8302238962785673, -0.8302238962785673, -1.0}},
          {six, {0.4688487934707144, -0.4688487934707144, -1.0}},
          {six, {0.1088646525710102, -0.3647692565366892, -0.744095396034321}}}},
        {"tet", "shunn-ham", 1, {{centre, {-0.5}}}},
        {"tet", "shunn-ham", 4, {{four, {-0.723606797749978, 0.170820393249934}}}},
        {"tet",
         "shunn-ham",
         10,
         {{four, {-0.8523301965475532, 0.5569905896426596}}, {six_edges, {-0.812488687768102, -0.187511312231898}}}},
        {"tet",
         "shunn-ham",
         20,
         {{four, {-0.9352948105455122, 0.8058844316365366}},
          {four, {-0.380461391454276, -0.858615825637172}},
          {twelve, {0.2331930661238736, -0.8792791169497158, -0.474634832224442}}}},
        {"tet",
         "shunn-ham",
         35,
         {{centre, {-0.5}},
          {four, {-0.946526448891253, 0.839579346673759}},
          {six_edges, {-0.0904908000310344, -0.9095091999689656}},
          {twelve, {0.4955197769636168, -0.9217955187287024, -0.651928739506212}},
          {twelve, {0.006237290029196, -0.55359792407537, -0.899041441878456}}}},
        {"tet",
         "shunn-ham",
         56,
         {{four, {-0.9700958696938816, 0.9102876090816449}},
          {four, {-0.731043330414012, 0.193129991242036}},
          {twelve, {0.55995201688308, -0.931807957607477, -0.696336101668126}},
          {twelve, {0.1053112862120352, -0.9075896991699967, -0.290131887872042}},
          {twelve, {0.076208645776001, -0.543619077862478, -0.988970490051045}},
          {twelve, {-0.607632480850882, -0.295389479824012, -0.801588559501094}}}},
        {"tet",
         "shunn-ham",
         84,
         {{four, {-0.946243051170366, 0.838729153511098}},
          {four, {-0.62571864839306, -0.12284405482082}},
          {four, {-0.355777136338286, -0.932668590985142}},
          {six_edges, {-0.052848329744126, -0.947151670255874}},
          {six_edges, {-0.295909475945288, -0.704090524054712}},
          {twelve, {0.464619819385896, -0.958093115559888, -0.54843358826612}},
          {twelve, {0.295115188173952, -0.806020533753068, -0.683074120667816}},
          {twelve, {0.585878512939236, -0.804783674219116, -0.976311164501004}},
          {twenty_four, {0.082368825600474, -0.732883678592864, -0.406997958913752, -0.942487188093858}}}},
    };
    return all;
}

} // namespace

std::vector<double> simplex_points(const Kind& kind, const std::string& rule, std::size_t n) {
    const auto found = std::ranges::find_if(
        rules(), [&](const Rule& one) { return one.kind == kind.name && one.name == rule && one.n_points == n; });
    std::vector<double> points;
    if (found != rules().end()) {
        for (const Orbit& orbit : found->orbits) {
            for (const char letter : pattern(orbit.symmetry, static_cast<std::size_t>(elvis::native::dimension(kind.shape)))) {
                points.push_back(orbit.numbers[static_cast<std::size_t>(letter - 'a')]);
            }
        }
    }
    return points;
}

} // namespace elvis_pyfr
