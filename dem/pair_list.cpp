#include "dem/pair_list.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <unordered_map>

#include "dem/prefetch.hpp"

namespace dem {

namespace {

/// The least that a block at rest may go before its candidates are found again, of the most.
constexpr double least_share = 0.1;

auto order_of(const Pair& pair) {
    return std::tuple(pair.block, pair.partner, pair.image);
}

/// Spheres of `shape` (exposed ones) that, seen from the partner's body frame, come within `reach` of its
/// box.
void spheres_near_box(const Shape& shape, const Rotation& to_partner, const Vector& offset,
                      const Shape& partner, double reach, std::vector<std::uint32_t>& found) {
    found.clear();
    const Vector low = partner.low.array() - reach, high = partner.high.array() + reach;
    for (const int sphere : shape.exposed) {
        const Vector p = to_partner * shape.spheres[static_cast<std::size_t>(sphere)] + offset;
        if ((p.array() >= low.array()).all() && (p.array() <= high.array()).all())
            found.push_back(static_cast<std::uint32_t>(sphere));
    }
}

}  // namespace

PairList::PairList(const Blocks& blocks, const Surroundings& surroundings, double skin)
    : blocks_(blocks), surroundings_(surroundings), most_freedom_(skin / 3) {
    double smallest = 1e300;
    for (std::size_t i = 0; i < blocks.size(); ++i) smallest = std::min(smallest, blocks.shape_of(i).radius);
    // Wide enough to live through a fall of a third of a block, narrow enough to list neighbours only.
    wide_skin_ = std::max(4 * skin, 0.3 * smallest);
    rebuild();
}

void PairList::rebuild() {
    freedom_.assign(blocks_.size(), {least_share * most_freedom_, least_share * most_freedom_});
    find_pairs();
    stale_.clear();
    stale_way_.clear();
    narrow_position_ = blocks_.position;
    narrow_orientation_ = blocks_.orientation;
    for (std::size_t k = 0; k < pairs_.size(); ++k) search(k);
    lay_in_order();
}

void PairList::Held::resize(std::size_t size) {
    candidates.resize(size);
    centres.resize(size);
    contacts.resize(size);
}

/// Gives a pair a new place at the end, with what it holds.
void PairList::make_room(Pair& pair, std::size_t room) {
    const std::size_t to = held_.size();
    held_.resize(to + room);
    std::copy_n(held_.contacts.begin() + pair.first, pair.contacts,
                held_.contacts.begin() + static_cast<std::ptrdiff_t>(to));
    pair.first = static_cast<std::uint32_t>(to);
    pair.room = static_cast<std::uint32_t>(room);
    ++moved_;
}

// Every step goes through the pairs in their order. Where each of them had its own few pieces of the heap,
// ten thousand blocks took four times as long a step: none of those pieces was in a cache, or its page in the
// table of pages.
void PairList::lay_in_order() {
    std::size_t size = 0;
    constexpr std::uint32_t spare = 2;  // candidates that come and go need no new place
    const auto room_of = [](const Pair& pair) {
        return pair.candidates == 0 ? 0 : std::max(pair.candidates, pair.contacts) + spare;
    };
    for (const auto& pair : pairs_) size += room_of(pair);
    Held laid;
    laid.resize(size);
    std::size_t to = 0;
    for (auto& pair : pairs_) {
        const auto copy = [&](const auto& from, std::size_t count, auto& into) {
            std::copy_n(from.begin() + pair.first, count, into.begin() + static_cast<std::ptrdiff_t>(to));
        };
        copy(held_.candidates, pair.candidates, laid.candidates);
        copy(held_.centres, pair.candidates, laid.centres);
        copy(held_.contacts, pair.contacts, laid.contacts);
        pair.first = static_cast<std::uint32_t>(to);
        pair.room = room_of(pair);
        to += pair.room;
    }
    held_ = std::move(laid);
    moved_ = 0;
}

void PairList::fetch(std::size_t index) const {
    const Pair& pair = pairs_[index];
    fetch_ahead(held_.candidates, pair.first, pair.candidates);
    if (!is_block(pair.partner)) fetch_ahead(held_.centres, pair.first, pair.candidates);
    fetch_ahead(held_.contacts, pair.first, pair.contacts);
}

/// The candidates of a pair, anew; true when it has its first or has lost its last.
bool PairList::search(std::size_t index) {
    Pair& pair = pairs_[index];
    found_.clear();
    found_centres_.clear();
    find_candidates(pair);
    ++searches_;
    if (found_.empty()) pair.contacts = 0;
    const std::size_t needed = std::max<std::size_t>(found_.size(), pair.contacts);
    if (needed > pair.room) make_room(pair, needed);
    std::copy(found_.begin(), found_.end(), held_.candidates.begin() + pair.first);
    std::copy(found_centres_.begin(), found_centres_.end(), held_.centres.begin() + pair.first);
    const bool changed = found_.empty() != (pair.candidates == 0);
    pair.candidates = static_cast<std::uint32_t>(found_.size());
    return changed;
}

/// The bounds of single steps add up to more than the way from where the block was: what is left of its
/// freedom is measured, and the block's candidates are out of date when there is nothing left.
void PairList::look_closer(std::uint32_t block, double way) {
    Freedom& freedom = freedom_[block];
    freedom.left = freedom.whole - moved_since(block, narrow_position_, narrow_orientation_);
    if (freedom.left >= 0) return;
    stale_.push_back(block);
    stale_way_.push_back(way);
}

bool PairList::update() {
    if (stale_.empty()) return false;
    bool changed = false;
    // Between two searches a block goes no farther than its freedom.
    for (const auto block : stale_)
        if (moved_since(block, wide_position_, wide_orientation_) > wide_skin_ / 2 - 2 * most_freedom_)
            changed = true;
    if (changed) find_pairs();
    // A search costs as much as some dozens of steps with a wider reach.
    constexpr double steps_between = 24;
    for (std::size_t k = 0; k < stale_.size(); ++k) {
        const auto block = stale_[k];
        narrow_position_[block] = blocks_.position[block];
        narrow_orientation_[block] = blocks_.orientation[block];
        const double whole =
            std::clamp(steps_between * stale_way_[k], least_share * most_freedom_, most_freedom_);
        freedom_[block] = {whole, whole};
    }
    for (const auto block : stale_)
        for (const auto entry : pairs_of(block)) changed = search(entry >> 1) || changed;
    stale_.clear();
    stale_way_.clear();
    // In order again before many pairs stand at the end.
    if (moved_ > pairs_.size() / 8) lay_in_order();
    return changed;
}

void PairList::find_pairs() {
    const std::size_t count = blocks_.size();
    double largest = 0;
    for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, blocks_.shape_of(i).radius);
    const double cell = 2 * largest + wide_skin_;
    const double period = surroundings_.period;
    const std::int64_t cells_in_period =
        period > 0 ? std::max<std::int64_t>(1, static_cast<std::int64_t>(period / cell)) : 0;
    const double cell_y = period > 0 ? period / static_cast<double>(cells_in_period) : cell;
    const auto index_of = [](double value, double size) {
        return static_cast<std::int64_t>(std::floor(value / size));
    };
    const auto wrap = [&](std::int64_t j) {
        return period > 0 ? ((j % cells_in_period) + cells_in_period) % cells_in_period : j;
    };
    const auto key_of = [](std::int64_t i, std::int64_t j, std::int64_t k) {
        return (static_cast<std::uint64_t>(i + 0x100000) & 0x1fffff) << 42 |
               (static_cast<std::uint64_t>(j + 0x100000) & 0x1fffff) << 21 |
               (static_cast<std::uint64_t>(k + 0x100000) & 0x1fffff);
    };
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells;
    cells.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vector& p = blocks_.position[i];
        cells[key_of(index_of(p.x(), cell), wrap(index_of(p.y(), cell_y)), index_of(p.z(), cell))].push_back(
            i);
    }

    std::vector<Pair> found;
    const auto add = [&](std::uint32_t block, std::uint32_t partner, std::int32_t image) {
        found.push_back({.block = block, .partner = partner, .image = image});
    };
    const std::int64_t reach_y =
        period > 0 && cells_in_period < 3 ? (cells_in_period - 1) / 2 + (cells_in_period == 2) : 1;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vector& p = blocks_.position[i];
        const double radius = blocks_.shape_of(i).radius;
        const std::int64_t cx = index_of(p.x(), cell), cy = index_of(p.y(), cell_y),
                           cz = index_of(p.z(), cell);
        for (std::int64_t x = cx - 1; x <= cx + 1; ++x)
            for (std::int64_t y = cy - reach_y; y <= cy + reach_y; ++y) {
                if (period > 0 && cells_in_period == 2 && y == cy - 1) continue;  // the same cell as cy + 1
                for (std::int64_t z = cz - 1; z <= cz + 1; ++z) {
                    const auto neighbours = cells.find(key_of(x, wrap(y), z));
                    if (neighbours == cells.end()) continue;
                    for (const auto j : neighbours->second) {
                        if (j <= i || (blocks_.is_fixed[i] && blocks_.is_fixed[j])) continue;
                        const Vector offset = blocks_.position[j] - p;
                        const double reach = radius + blocks_.shape_of(j).radius + wide_skin_;
                        if (period == 0) {
                            if (offset.squaredNorm() < reach * reach) add(i, j, 0);
                            continue;
                        }
                        // In a narrow box two images may come near before the next look.
                        const auto last =
                            static_cast<std::int32_t>(std::floor((reach - offset.y()) / period));
                        for (auto image =
                                 static_cast<std::int32_t>(std::ceil((-reach - offset.y()) / period));
                             image <= last; ++image)
                            if ((offset + Vector(0, image * period, 0)).squaredNorm() < reach * reach)
                                add(i, j, image);
                    }
                }
            }
        if (blocks_.is_fixed[i]) continue;
        if (!surroundings_.fixed_spheres.empty()) add(i, static_cast<std::uint32_t>(count), 0);
        for (std::uint32_t k = 0; k < surroundings_.planes.size(); ++k) {
            const Plane& plane = surroundings_.planes[k];
            if ((p - plane.point).dot(plane.normal) < radius + wide_skin_)
                add(i, static_cast<std::uint32_t>(count) + 1 + k, 0);
        }
    }
    const auto is_before = [](const Pair& a, const Pair& b) { return order_of(a) < order_of(b); };
    std::sort(found.begin(), found.end(), is_before);
    // However far apart by now, those that touched at the last look: a sleeper must be told that they parted.
    std::vector<Pair> touched;
    for (std::size_t k = 0; k < pairs_.size(); ++k)
        if (last_[k].is_acting() && !std::binary_search(found.begin(), found.end(), pairs_[k], is_before))
            touched.push_back(
                {.block = pairs_[k].block, .partner = pairs_[k].partner, .image = pairs_[k].image});
    found.insert(found.end(), touched.begin(), touched.end());
    std::inplace_merge(found.begin(), found.end() - static_cast<std::ptrdiff_t>(touched.size()), found.end(),
                       is_before);

    // What old pairs hold goes over to the new ones; both lists are in order.
    std::vector<PairForces> last(found.size());
    std::vector<std::uint8_t> is_stale(count, 0);
    for (const auto block : stale_) is_stale[block] = 1;
    std::size_t old = 0;
    for (std::size_t k = 0; k < found.size(); ++k) {
        while (old < pairs_.size() && order_of(pairs_[old]) < order_of(found[k])) ++old;
        if (old < pairs_.size() && order_of(pairs_[old]) == order_of(found[k])) {
            found[k] = pairs_[old];
            last[k] = last_[old++];
        } else if (!is_stale[found[k].block]) {
            is_stale[found[k].block] = 1;
            stale_.push_back(found[k].block);
            stale_way_.push_back(0);
        }
    }
    pairs_ = std::move(found);
    last_ = std::move(last);
    wide_position_ = blocks_.position;
    wide_orientation_ = blocks_.orientation;
    find_incidence();
}

void PairList::find_incidence() {
    const std::size_t count = blocks_.size();
    incidence_begin_.assign(count + 1, 0);
    for (const auto& pair : pairs_) {
        ++incidence_begin_[pair.block + 1];
        if (is_block(pair.partner)) ++incidence_begin_[pair.partner + 1];
    }
    for (std::size_t i = 0; i < count; ++i) incidence_begin_[i + 1] += incidence_begin_[i];
    incidence_.resize(incidence_begin_[count]);
    std::vector<std::uint32_t> next(incidence_begin_.begin(), incidence_begin_.end() - 1);
    for (std::uint32_t k = 0; k < pairs_.size(); ++k) {
        incidence_[next[pairs_[k].block]++] = 2 * k;
        if (is_block(pairs_[k].partner)) incidence_[next[pairs_[k].partner]++] = 2 * k + 1;
    }
}

void PairList::find_candidates(const Pair& pair) {
    const double reach = reach_of(pair);
    if (is_block(pair.partner)) {
        find_block_candidates(pair);
        return;
    }
    const Shape& shape = blocks_.shape_of(pair.block);
    for (const int exposed : shape.exposed) {
        const auto sphere = static_cast<std::uint32_t>(exposed);
        const Vector centre = blocks_.sphere_centre(pair.block, sphere);
        if (is_fixed_spheres(pair.partner)) {
            near_.clear();
            surroundings_.fixed_spheres.find_near(
                centre, 0.5 * (shape.diameter + surroundings_.fixed_spheres.diameter()) + reach, near_);
            for (const auto& other : near_) {
                found_.push_back({sphere, other.sphere});
                found_centres_.push_back(other.centre);
            }
        } else {
            const Plane& wall = plane(pair.partner);
            if ((centre - wall.point).dot(wall.normal) < 0.5 * shape.diameter + reach)
                found_.push_back({sphere, 0});
        }
    }
}

void PairList::find_block_candidates(const Pair& pair) {
    const Shape &a = blocks_.shape_of(pair.block), &b = blocks_.shape_of(pair.partner);
    const double reach = 0.5 * (a.diameter + b.diameter) + reach_of(pair);
    Vector offset = blocks_.position[pair.partner] - blocks_.position[pair.block];
    offset.y() += pair.image * surroundings_.period;
    const double bound = a.radius + b.radius + reach_of(pair);
    if (offset.squaredNorm() > bound * bound) return;
    const Rotation &turn_a = blocks_.rotation[pair.block], &turn_b = blocks_.rotation[pair.partner];
    const Rotation b_to_a = turn_a.transpose() * turn_b;
    const Vector b_in_a = turn_a.transpose() * offset;
    spheres_near_box(b, b_to_a, b_in_a, a, reach, near_b_);
    if (near_b_.empty()) return;
    spheres_near_box(a, b_to_a.transpose(), -(b_to_a.transpose() * b_in_a), b, reach, near_a_);
    centres_b_.clear();
    for (const auto j : near_b_) centres_b_.push_back(b_to_a * b.spheres[j] + b_in_a);
    for (const auto i : near_a_)
        for (std::size_t k = 0; k < near_b_.size(); ++k)
            if ((centres_b_[k] - a.spheres[i]).squaredNorm() < reach * reach)
                found_.push_back({i, near_b_[k]});
}

std::vector<TouchingPair> PairList::touching() const {
    std::vector<TouchingPair> some;
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
        const Pair& pair = pairs_[k];
        if (pair.contacts == 0) continue;
        const auto held = contacts(pair);
        some.push_back({pair.block, pair.partner, pair.image, {held.begin(), held.end()}, last_[k]});
    }
    return some;
}

std::size_t PairList::contact_count() const {
    std::size_t count = 0;
    for (const auto& pair : pairs_) count += pair.contacts;
    return count;
}

void PairList::restore(const std::vector<TouchingPair>& saved) {
    std::size_t place = 0;
    const auto order_of_saved = [](const TouchingPair& pair) {
        return std::tuple(pair.block, pair.partner, pair.image);
    };
    for (const auto& pair : saved) {
        while (place < pairs_.size() && order_of(pairs_[place]) < order_of_saved(pair)) ++place;
        if (place == pairs_.size() || order_of(pairs_[place]) != order_of_saved(pair)) continue;
        if (pair.contacts.size() > pairs_[place].room) make_room(pairs_[place], pair.contacts.size());
        set_contacts(place, pair.contacts);
        last_[place] = pair.last;
    }
}

}  // namespace dem
