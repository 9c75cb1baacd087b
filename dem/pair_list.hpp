/// Who can touch whom: pairs of blocks first, then pairs of their spheres.
///
/// Two lists with a skin each. Pairs of bodies follow from the blocks' bounding spheres and are found again,
/// all at once, when some block has moved half of the wide skin. Sphere pairs (candidates) of one block are
/// found again when that block has moved a third of the narrow skin; so a tumbling block costs nothing to
/// those at rest.
///
/// Results do not depend on the lists: pairs and candidates stand in a fixed order (block, partner, sphere,
/// sphere), and only those that touch contribute.
#pragma once

#include <cstdint>
#include <memory>
#include <memory_resource>
#include <vector>

#include "dem/blocks.hpp"
#include "dem/boundaries.hpp"

namespace dem {

/// Two spheres that touch, with what the contact remembers.
struct Contact {
    std::uint32_t a, b;  ///< sphere of the block, sphere of the partner
    double stiffness;    ///< normal, N/m, at the last step
    Vector spring;       ///< tangential spring force on the block, N, world axes
};

/// Sphere `a` of the block and sphere `b` of the partner (0 for a plane).
struct Candidate {
    std::uint32_t a, b;
};

/// What a pair does to its two bodies.
struct PairForces {
    Vector force{0, 0, 0};            ///< on the block, N; the partner feels the opposite
    Vector torque_on_block{0, 0, 0};  ///< N m, about the block's centre
    Vector offset{0, 0, 0};  ///< from the block's centre to the partner's, m: the torque on the partner
                             ///< is offset x force - torque_on_block
    Vector damping_force{0, 0, 0};   ///< the dashpots' part of the force, N
    Vector damping_torque{0, 0, 0};  ///< and of the torque on the block, N m
    double dissipated = 0;           ///< by sliding springs in that step, J
    double largest_overlap = 0;      ///< m
};

/// A block and a partner: a later block, the fixed spheres (number blocks.size()), or a plane (the numbers
/// after it).
struct Pair {
    explicit Pair(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
        : candidates(memory), centres(memory), contacts(memory) {}

    std::uint32_t block = 0, partner = 0;
    std::int32_t image = 0;  ///< the partner stands this many widths of the periodic box further in y
    std::pmr::vector<Candidate> candidates;
    std::pmr::vector<Vector> centres;  ///< of the fixed spheres among the candidates, m
    std::pmr::vector<Contact>
        contacts;     ///< room for all candidates is kept, so that evaluation allocates nothing
    PairForces last;  ///< of the last step before a look at the water, a sample or a saved state
};

/// The bodies that pairs are made of.
struct Surroundings {
    FixedSpheres fixed_spheres;
    std::vector<Plane> planes;
    double period = 0;  ///< width of the periodic box in y, m; 0: not periodic
};

class PairList {
 public:
    /// `skin`: of the sphere pairs, m.
    PairList(const Blocks& blocks, const Surroundings& surroundings, double skin);

    /// Before blocks move; then note_motion() for each that may have moved, then update().
    void begin_update() { stale_.clear(); }
    void note_motion(std::uint32_t block) {
        if (moved_since(block, narrow_position_, narrow_orientation_) > skin_ / 3) stale_.push_back(block);
    }
    /// Finds again what has become out of date.
    /// Returns true when pairs came or went, or got their first candidates or lost their last.
    bool update();

    /// What needs to be known of every pair to see whether it must be evaluated.
    struct Key {
        std::uint32_t block, partner;
        std::uint8_t has_candidates;
    };
    const std::vector<Key>& keys() const { return keys_; }

    std::vector<Pair>& pairs() { return pairs_; }
    const std::vector<Pair>& pairs() const { return pairs_; }
    /// Pairs of one block, as 2 * pair + (1 where the block is the partner), ascending.
    struct Incidence {
        const std::uint32_t *first, *last;
        const std::uint32_t* begin() const { return first; }
        const std::uint32_t* end() const { return last; }
    };
    Incidence pairs_of(std::size_t block) const {
        return {incidence_.data() + incidence_begin_[block], incidence_.data() + incidence_begin_[block + 1]};
    }
    bool is_block(std::uint32_t partner) const { return partner < blocks_.size(); }
    bool is_fixed_spheres(std::uint32_t partner) const { return partner == blocks_.size(); }
    const Plane& plane(std::uint32_t partner) const {
        return surroundings_.planes[partner - blocks_.size() - 1];
    }
    /// Puts back the contacts of a saved run; every pair they name must be listed (it is: they touch).
    void restore(const std::vector<Pair>& saved);
    /// Everything is found again from the present poses.
    void rebuild();

 private:
    void find_pairs();
    void find_candidates(Pair& pair);
    bool refresh(std::size_t pair);
    void find_block_candidates(Pair& pair);
    void find_incidence();
    void lay_in_order();
    /// The farthest point goes at most |dx| + 2 R sin(angle/2), and |vec(q0* q)| is sin(angle/2).
    double moved_since(std::size_t block, const std::vector<Vector>& position,
                       const std::vector<Quaternion>& orientation) const {
        const double turned = (orientation[block].conjugate() * blocks_.orientation[block]).vec().norm();
        return (blocks_.position[block] - position[block]).norm() +
               2 * blocks_.shape_of(block).radius * turned;
    }

    const Blocks& blocks_;
    const Surroundings& surroundings_;
    double skin_, wide_skin_;
    std::unique_ptr<std::pmr::monotonic_buffer_resource> memory_;  // of what the pairs hold, in their order
    std::size_t refreshed_ = 0;                                    // pairs since it was laid out
    std::vector<Pair> pairs_;
    std::vector<Key> keys_;  // in step with pairs_
    std::vector<std::uint32_t> incidence_, incidence_begin_;
    std::vector<Vector> narrow_position_, wide_position_;
    std::vector<Quaternion> narrow_orientation_, wide_orientation_;
    std::vector<std::uint32_t> stale_, near_a_, near_b_;
    std::vector<FixedSpheres::Near> near_;
    std::vector<Vector> centres_b_;
};

}  // namespace dem
