#include "second_view.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace elvis::view {

namespace {

/** What the scene says of each item, but for whether it is shown. */
std::vector<std::string> items_in(const Scene& scene) {
    std::vector<std::string> items;
    for (const ItemId& item : items_of(scene)) {
        Json part = part_of(scene, item);
        part.erase("visible");
        items.push_back(part.dump());
    }
    return items;
}

} // namespace

void SecondView::turn_on(const Model& model) {
    m_is_on = true;
    m_is_linked = true;
    m_camera = model.camera();
    m_size = size_of(model.scene());
    m_items = items_in(model.scene());
    m_is_shown.clear();
    for (const ItemId& item : items_of(model.scene())) {
        m_is_shown.push_back(is_shown(model.scene(), item));
    }
    follow(model);
}

void SecondView::set_linked(const Model& model, bool is_linked) {
    m_camera = camera(model);
    m_is_linked = is_linked;
}

void SecondView::set_camera(Model& model, const Camera& camera) {
    if (m_is_linked) {
        model.set_camera(camera);
    } else {
        m_camera = camera;
    }
}

void SecondView::set_shown(std::size_t item, bool is_shown) {
    if (item < m_is_shown.size()) {
        m_is_shown[item] = is_shown;
    }
}

/** Items that were added or removed are those between what is alike at the beginning and at the end of the lists. */
void SecondView::follow_items(const Scene& first) {
    std::vector<std::string> items = items_in(first);
    if (items.size() != m_items.size()) {
        const auto [before, now] = std::ranges::mismatch(m_items, items);
        const auto n_begin = now - items.begin();
        const auto n_most = static_cast<std::ptrdiff_t>(std::min(items.size(), m_items.size())) - n_begin;
        std::ptrdiff_t n_end = 0;
        while (n_end < n_most && *(m_items.end() - 1 - n_end) == *(items.end() - 1 - n_end)) {
            ++n_end;
        }
        std::vector<bool> shown(m_is_shown.begin(), m_is_shown.begin() + n_begin);
        shown.resize(items.size() - static_cast<std::size_t>(n_end), true);
        shown.insert(shown.end(), m_is_shown.end() - n_end, m_is_shown.end());
        m_is_shown = std::move(shown);
    }
    m_items = std::move(items);
}

void SecondView::follow(const Model& model) {
    follow_items(model.scene());
    Scene scene = model.scene();
    say_camera(scene["camera"], camera(model));
    scene["image"]["size"] = m_size;
    const std::vector<ItemId> items = items_of(scene);
    for (std::size_t i = 0; i < items.size(); ++i) {
        elvis::view::set_shown(scene, items[i], m_is_shown[i]);
    }
    if (scene != m_scene) {
        m_scene = std::move(scene);
        ++m_revision;
    }
}

} // namespace elvis::view
