#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace elvis {

/** The id of a variable, and which component of which component of it. */
using Place = std::vector<std::uint32_t>;

/** Which values are known to stand in which places of a function's variables. */
class KnownValues {
public:
    std::optional<std::uint32_t> at(const Place& place) const;
    /** Whether a value is known of anything inside a place. */
    bool knows_within(const Place& place) const;

    void set(const Place& place, std::uint32_t value);
    /** Of this place alone. */
    void forget(const Place& place);
    /** Of all that lies in a place. */
    void forget_within(const Place& place);

    /** A moment to go back to. */
    std::size_t moment() const { return m_changes.size(); }
    void go_back(std::size_t moment);

    using Values = std::map<Place, std::optional<std::uint32_t>>;
    /** Of the places that have changed since: their values now. */
    Values changed_since(std::size_t moment) const;
    /** Of two ways since that moment, of which this is at the end of the second: keeps what holds after both. */
    void keep_common(std::size_t moment, const Values& first);
    void apply(const Values& values);

private:
    struct Change {
        Place place;
        std::optional<std::uint32_t> before;
    };

    void change(const Place& place, std::optional<std::uint32_t> value);

    std::map<Place, std::uint32_t> m_values;
    std::vector<Change> m_changes;
};

} // namespace elvis
