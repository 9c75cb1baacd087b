#include "dem/pair_list.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>
#include <unordered_map>

namespace dem {

namespace {

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
    : blocks_(blocks), surroundings_(surroundings), skin_(skin) {
    double smallest = 1e300;
    for (std::size_t i = 0; i < blocks.size(); ++i) smallest = std::min(smallest, blocks.shape_of(i).radius);
    // Wide enough to live through a fall of a third of a block, narrow enough to list neighbours only.
    wide_skin_ = std::max(2 * skin, 0.3 * smallest);
    memory_ = std::make_unique<std::pmr::monotonic_buffer_resource>();
    rebuild();
}

void PairList::rebuild() {
    find_pairs();
    narrow_position_ = blocks_.position;
    narrow_orientation_ = blocks_.orientation;
    for (std::size_t k = 0; k < pairs_.size(); ++k) refresh(k);
    lay_in_order();
}

// Every step goes through the pairs in their order. Where each of them had its own few pieces of the heap,
// ten thousand blocks took four times as long a step: none of those pieces was in a cache, or its page in the
// table of pages.
void PairList::lay_in_order() {
    constexpr std::size_t first_piece = 1 << 16;  // bytes
    auto memory = std::make_unique<std::pmr::monotonic_buffer_resource>(first_piece);
    for (auto& pair : pairs_) {
        Pair laid(memory.get());
        laid.block = pair.block;
        laid.partner = pair.partner;
        laid.image = pair.image;
        laid.candidates.assign(pair.candidates.begin(), pair.candidates.end());
        laid.centres.assign(pair.centres.begin(), pair.centres.end());
        laid.contacts.reserve(pair.candidates.size());
        laid.contacts.assign(pair.contacts.begin(), pair.contacts.end());
        laid.last = pair.last;
        std::destroy_at(&pair);
        std::construct_at(&pair, std::move(laid));
    }
    memory_ = std::move(memory);
    refreshed_ = 0;
}

bool PairList::refresh(std::size_t index) {
    Pair& pair = pairs_[index];
    find_candidates(pair);
    const std::uint8_t has_candidates = !pair.candidates.empty();
    if (!has_candidates) pair.contacts.clear();
    pair.contacts.reserve(pair.candidates.size());
    ++refreshed_;
    const bool changed = has_candidates != keys_[index].has_candidates;
    keys_[index].has_candidates = has_candidates;
    return changed;
}

bool PairList::update() {
    // A candidate pair is found when one of its blocks is refreshed; the other may then be a third of the
    // skin away from its own reference and go another third on the far side of it: together never more than
    // the skin.
    if (stale_.empty()) return false;
    bool changed = false;
    for (const auto block : stale_)
        if (moved_since(block, wide_position_, wide_orientation_) > wide_skin_ / 2) changed = true;
    if (changed) find_pairs();
    for (const auto block : stale_) {
        narrow_position_[block] = blocks_.position[block];
        narrow_orientation_[block] = blocks_.orientation[block];
        for (const auto entry : pairs_of(block)) changed = refresh(entry >> 1) || changed;
    }
    // Lists that grew have moved to the end of the memory: in order again before many have.
    if (refreshed_ > pairs_.size()) lay_in_order();
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
        Pair pair(memory_.get());
        pair.block = block;
        pair.partner = partner;
        pair.image = image;
        found.push_back(std::move(pair));
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
                        Vector offset = blocks_.position[j] - p;
                        const auto image =
                            period > 0 ? static_cast<std::int32_t>(-std::lround(offset.y() / period)) : 0;
                        offset.y() += image * period;
                        const double reach = radius + blocks_.shape_of(j).radius + wide_skin_;
                        if (offset.squaredNorm() < reach * reach) add(i, j, image);
                    }
                }
            }
        if (blocks_.is_fixed[i]) continue;
        if (!surroundings_.fixed_spheres.empty()) {
            const auto image = period > 0 ? static_cast<std::int32_t>(std::floor(p.y() / period)) : 0;
            add(i, static_cast<std::uint32_t>(count), image);
        }
        for (std::uint32_t k = 0; k < surroundings_.planes.size(); ++k) {
            const Plane& plane = surroundings_.planes[k];
            if ((p - plane.point).dot(plane.normal) < radius + wide_skin_)
                add(i, static_cast<std::uint32_t>(count) + 1 + k, 0);
        }
    }
    std::sort(found.begin(), found.end(),
              [](const Pair& a, const Pair& b) { return order_of(a) < order_of(b); });

    // What old pairs hold goes over to the new ones; both lists are in order.
    auto old = pairs_.begin();
    for (auto& pair : found) {
        while (old != pairs_.end() && order_of(*old) < order_of(pair)) ++old;
        if (old != pairs_.end() && order_of(*old) == order_of(pair))
            pair = std::move(*old++);
        else
            stale_.push_back(pair.block);
    }
    pairs_ = std::move(found);
    keys_.clear();
    for (const auto& pair : pairs_) keys_.push_back({pair.block, pair.partner, !pair.candidates.empty()});
    std::sort(stale_.begin(), stale_.end());
    stale_.erase(std::unique(stale_.begin(), stale_.end()), stale_.end());
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

void PairList::find_candidates(Pair& pair) {
    pair.candidates.clear();
    pair.centres.clear();
    if (is_block(pair.partner)) {
        find_block_candidates(pair);
        return;
    }
    const Shape& shape = blocks_.shape_of(pair.block);
    for (const int exposed : shape.exposed) {
        const auto sphere = static_cast<std::uint32_t>(exposed);
        Vector centre = blocks_.sphere_centre(pair.block, sphere);
        if (is_fixed_spheres(pair.partner)) {
            centre.y() -= pair.image * surroundings_.period;
            near_.clear();
            const double reach = 0.5 * (shape.diameter + surroundings_.fixed_spheres.diameter()) + skin_;
            surroundings_.fixed_spheres.find_near(centre, reach, near_);
            for (const auto& other : near_) {
                pair.candidates.push_back({sphere, other.sphere});
                pair.centres.push_back(other.centre);
            }
        } else {
            const Plane& wall = plane(pair.partner);
            if ((centre - wall.point).dot(wall.normal) < 0.5 * shape.diameter + skin_)
                pair.candidates.push_back({sphere, 0});
        }
    }
}

void PairList::find_block_candidates(Pair& pair) {
    const Shape &a = blocks_.shape_of(pair.block), &b = blocks_.shape_of(pair.partner);
    const double reach = 0.5 * (a.diameter + b.diameter) + skin_;
    Vector offset = blocks_.position[pair.partner] - blocks_.position[pair.block];
    offset.y() += pair.image * surroundings_.period;
    const double bound = a.radius + b.radius + skin_;
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
                pair.candidates.push_back({i, near_b_[k]});
}

void PairList::restore(const std::vector<Pair>& saved) {
    auto place = pairs_.begin();
    for (const auto& pair : saved) {
        while (place != pairs_.end() && order_of(*place) < order_of(pair)) ++place;
        if (place == pairs_.end() || order_of(*place) != order_of(pair)) continue;
        place->contacts = pair.contacts;
        place->last = pair.last;
    }
}

}  // namespace dem
