// What surfaces made of many triangles or patches have in common: the way of a ray through the hierarchy over these, its items, and how
// a crossing found in several of them is judged.

#include "surface/hit.glsl"
#include "tiles/hierarchy.glsl"

struct core_box_ray {
    vec3 origin, inverse;
    float tolerance, from, to;
};

// `shift`: what was added to the ray's origin to make `origin`.
core_box_ray core_make_box_ray(core_surface_ray ray, elvis_vec3 origin, elvis_vec3 shift) {
    core_box_ray result;
    result.origin = vec3(origin);
    const vec3 direction = vec3(ray.direction);
    const vec3 tiny = vec3(1e-30);
    result.inverse = 1.0 / mix(direction, tiny, lessThan(abs(direction), tiny));
    const vec3 size = abs(vec3(shift));
    result.tolerance = float(elvis_real(2) * ray.noise) + 8.0 * CORE_FLOAT_ROUNDOFF * max(max(size.x, size.y), size.z);
    result.from = float(core_first_t(ray));
    result.to = float(ray.to);
    return result;
}

// Where the ray enters the box, a little before; more than 3e38 if it does not meet it between its ends, or before `farthest`.
float core_box_entry(core_node node, core_box_ray ray, float farthest) {
    const vec3 a = (node.lower - ray.tolerance - ray.origin) * ray.inverse;
    const vec3 b = (node.upper + ray.tolerance - ray.origin) * ray.inverse;
    const vec3 low = min(a, b), high = max(a, b);
    const float enter = max(max(low.x, low.y), low.z), leave = min(min(high.x, high.y), high.z);
    const float slack = 1e-5 * (abs(enter) + abs(leave));
    const bool is_met = enter <= leave + slack && leave + slack >= ray.from && enter - slack <= min(ray.to, farthest);
    return is_met ? enter - slack : 3.3e38;
}

// Nodes that wait.
uint core_stack[CORE_STACK_SIZE];

// The item of the next node, if that is a leaf that the ray meets before `farthest`; else CORE_NO_NODE, and its children wait, the nearer
// one before the other.
uint core_next_item(core_box_ray ray, float farthest, inout uint stack_size) {
    stack_size -= 1u;
    const core_node node = core_fetch_node(core_stack[stack_size]);
    const bool is_met = core_box_entry(node, ray, farthest) < 3e38;
    if (is_met && !node.is_leaf) {
        const float first = core_box_entry(core_fetch_node(node.child), ray, farthest);
        const float second = core_box_entry(core_fetch_node(node.child + 1u), ray, farthest);
        core_stack[stack_size] = node.child + (second < first ? 0u : 1u);
        core_stack[stack_size + 1u] = node.child + (second < first ? 1u : 0u);
        stack_size += 2u;
    }
    return is_met && node.is_leaf ? node.child : CORE_NO_NODE;
}

// Rounding moves edges of items across the ray by a little. A crossing well inside some item is sure. One near edges only is, if
// two items that face the same way hold it; near the edge of a single item, or of two that fold back there, it is undecided.
struct core_votes {
    bool is_sure;
    uint n_facing, n_averted;
    // The nearest near miss.
    elvis_real near_t, near_error;
    bool is_near_facing;
};

core_votes core_no_votes() { return core_votes(false, 0u, 0u, CORE_FAR, elvis_real(0), false); }

// An item that holds the crossing, or nearly. Returns whether it is the nearest one so far.
bool core_vote(inout core_votes votes, core_hit best, elvis_real t, elvis_real error, bool is_within, bool is_clear, bool is_facing,
               bool counts) {
    const bool is_same = abs(t - best.t) <= elvis_real(2) * (error + best.error);
    const bool is_better = counts && is_within && t < best.t;
    const bool is_news = is_better && !is_same;
    // The near miss found before may be of the same crossing.
    const bool is_near_same = abs(t - votes.near_t) <= elvis_real(2) * (error + votes.near_error);
    const bool takes_part = counts && (is_news || is_same);
    votes.n_facing = is_news ? (is_near_same && votes.is_near_facing ? 1u : 0u) : votes.n_facing;
    votes.n_averted = is_news ? (is_near_same && !votes.is_near_facing ? 1u : 0u) : votes.n_averted;
    votes.n_facing += takes_part && is_facing ? 1u : 0u;
    votes.n_averted += takes_part && !is_facing ? 1u : 0u;
    votes.is_sure = (votes.is_sure && !is_news) || (takes_part && is_within && is_clear);
    const bool is_miss = counts && !is_within && t < votes.near_t;
    votes.near_t = is_miss ? t : votes.near_t;
    votes.near_error = is_miss ? error : votes.near_error;
    votes.is_near_facing = is_miss ? is_facing : votes.is_near_facing;
    return is_better;
}

bool core_is_undecided(core_votes votes, core_hit best) {
    const bool is_missed_before = votes.near_t < best.t - elvis_real(2) * (votes.near_error + best.error);
    return is_missed_before || (best.is_hit && !votes.is_sure && max(votes.n_facing, votes.n_averted) < 2u);
}
