#include "boundary.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>
#include <string_view>

namespace nektarpp {

namespace {

char element_kind(Shape shape) {
    constexpr std::string_view kinds = "HRPAQT";
    return kinds[static_cast<std::size_t>(shape)];
}

bool contains(const std::vector<IdRange>& ranges, std::int64_t id) {
    return std::ranges::any_of(ranges, [&](const IdRange& range) { return range.first <= id && id <= range.last; });
}

/** Something known by an id, sorted for look-up by ranges. */
struct ById {
    std::int64_t id = 0;
    std::uint64_t element = 0;
    std::uint32_t side = 0;
};

std::vector<ById> sorted(std::vector<ById> list) {
    std::ranges::stable_sort(list, {}, &ById::id);
    return list;
}

/** Calls visit for what lies in a range of ids. */
template <class Visit> void for_each_in(const std::vector<ById>& list, const IdRange& range, Visit&& visit) {
    for (auto at = std::ranges::lower_bound(list, range.first, {}, &ById::id); at != list.end() && at->id <= range.last; ++at) {
        visit(*at);
    }
}

} // namespace

std::vector<bool> elements_of_domain(const GeometryData& data) {
    if (data.domain.empty()) {
        return std::vector<bool>(data.elements.size(), true);
    }
    std::vector<bool> chosen(data.elements.size(), false);
    std::array<std::vector<ById>, 6> by_shape;
    for (std::uint64_t element = 0; element < data.elements.size(); ++element) {
        const ElementRecord& record = data.elements[element];
        by_shape[static_cast<std::size_t>(record.shape)].push_back({record.id, element, 0});
    }
    for (std::vector<ById>& list : by_shape) {
        list = sorted(std::move(list));
    }
    for (const IdRange& range : data.domain) {
        if (std::ranges::none_of(data.composites, [&](const Composite& c) { return contains({range}, c.id); })) {
            throw elvis::api::Error(ELVIS_ERROR_FORMAT, data.path,
                                    "DOMAIN: composite C[" + std::to_string(range.first) + "] does not exist");
        }
    }
    for (const Composite& composite : data.composites) {
        if (!contains(data.domain, composite.id)) {
            continue;
        }
        for (const IdGroup& group : composite.groups) {
            for (std::size_t shape = 0; shape < by_shape.size(); ++shape) {
                if (element_kind(static_cast<Shape>(shape)) != group.kind) {
                    continue;
                }
                for (const IdRange& range : group.ranges) {
                    for_each_in(by_shape[shape], range, [&](const ById& found) { chosen[found.element] = true; });
                }
            }
        }
    }
    return chosen;
}

BoundaryGroups find_boundary_groups(const GeometryData& data, const std::vector<bool>& is_in_domain) {
    std::vector<ById> sides;
    for (std::uint64_t element = 0; element < data.elements.size(); ++element) {
        const ElementRecord& record = data.elements[element];
        for (std::uint32_t side = 0; is_in_domain[element] && side < n_sides(record.shape); ++side) {
            sides.push_back({record.sides[side], element, side});
        }
    }
    sides = sorted(std::move(sides));
    // On the boundary are sides with one element.
    std::vector<ById> boundary;
    for (std::size_t at = 0; at < sides.size(); ++at) {
        const bool is_shared =
            (at > 0 && sides[at - 1].id == sides[at].id) || (at + 1 < sides.size() && sides[at + 1].id == sides[at].id);
        if (!is_shared) {
            boundary.push_back(sides[at]);
        }
    }
    BoundaryGroups groups;
    std::array<std::int32_t, 6> none{};
    none.fill(ELVIS_GROUP_NONE);
    groups.of_element.assign(data.elements.size(), none);
    // Q and T of three dimensions are faces, as F is; E and S of two are edges.
    const std::string_view kinds = data.dimension == 3 ? "FQT" : "ES";
    for (const Composite& composite : data.composites) {
        const auto number = static_cast<std::int32_t>(groups.names.size());
        bool is_new = false;
        for (const IdGroup& group : composite.groups) {
            if (kinds.find(group.kind) == std::string_view::npos) {
                continue;
            }
            for (const IdRange& range : group.ranges) {
                for_each_in(boundary, range, [&](const ById& found) {
                    std::int32_t& of_side = groups.of_element[found.element][found.side];
                    is_new = is_new || of_side == ELVIS_GROUP_NONE;
                    of_side = of_side == ELVIS_GROUP_NONE ? number : of_side;
                });
            }
        }
        if (is_new) {
            groups.names.push_back(composite.name.empty() ? "C[" + std::to_string(composite.id) + "]" : composite.name);
        }
    }
    return groups;
}

} // namespace nektarpp
