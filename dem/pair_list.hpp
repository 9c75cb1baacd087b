/// Who can touch whom: pairs of blocks first, then pairs of their spheres.
///
/// Two lists with a skin each. Pairs of bodies follow from the blocks' bounding spheres and are found again,
/// all at once, when some block has moved nearly half of the wide skin. Sphere pairs (candidates) of one
/// block are found again when that block has used up its own freedom: how far it may go is chosen each time
/// by how fast it is, so a block at rest tests hardly more spheres than it touches, and a tumbling one is not
/// listed anew every few steps; and it costs nothing to those at rest.
///
/// Results do not depend on the lists: pairs and candidates stand in a fixed order (block, partner, sphere,
/// sphere), and only those that touch contribute.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
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

    bool is_acting() const { return !force.isZero(0) || !torque_on_block.isZero(0); }
};

/// A block and a partner: a later block, the fixed spheres (number blocks.size()), or a plane (the numbers
/// after it). What it holds lies in the list's own arrays, in the order of pairs.
///
/// In a periodic box positions go on across its sides, so that which image of a block is meant does not
/// change while the two touch; of a fixed sphere the image is that whose place the candidate holds.
struct Pair {
    std::uint32_t block = 0, partner = 0;
    std::int32_t image = 0;             ///< the partner, a block, stands this many periods further in y
    std::uint32_t first = 0, room = 0;  ///< where in those arrays, and for how many
    std::uint32_t candidates = 0, contacts = 0;
};

/// A pair that touches, by itself: for a saved state.
struct TouchingPair {
    std::uint32_t block = 0, partner = 0;
    std::int32_t image = 0;
    std::vector<Contact> contacts;
    PairForces last;
};

/// The bodies that pairs are made of.
struct Surroundings {
    FixedSpheres fixed_spheres;
    std::vector<Plane> planes;
    double period = 0;  ///< width of the periodic box in y, m; 0: not periodic
    double mound_floor =
        -std::numeric_limits<double>::infinity();  ///< lowest sphere of the mound, m; -infinity: no mound
};

class PairList {
 public:
    /// `skin`: largest of the sphere pairs, m.
    PairList(const Blocks& blocks, const Surroundings& surroundings, double skin);

    /// After the motion of a block in one step, in ascending order of blocks; then update().
    /// `way`: no point of the block has gone farther in that step, m.
    void note_motion(std::uint32_t block, double way) {
        freedom_[block].left -= way;
        if (freedom_[block].left < 0) look_closer(block, way);
    }
    /// Finds again what has become out of date.
    /// Returns true when pairs came or went, or got their first candidates or lost their last.
    bool update();

    const std::vector<Pair>& pairs() const { return pairs_; }
    std::span<const Candidate> candidates(const Pair& pair) const {
        return {held_.candidates.data() + pair.first, pair.candidates};
    }
    /// Of the fixed spheres among the candidates, m; meaningless for other partners.
    std::span<const Vector> centres(const Pair& pair) const {
        return {held_.centres.data() + pair.first, pair.candidates};
    }
    std::span<const Contact> contacts(const Pair& pair) const {
        return {held_.contacts.data() + pair.first, pair.contacts};
    }
    /// Replaces the contacts of a pair by some of its candidates'; different pairs may be set at once.
    void set_contacts(std::size_t pair, std::span<const Contact> contacts) {
        std::copy(contacts.begin(), contacts.end(), held_.contacts.begin() + pairs_[pair].first);
        pairs_[pair].contacts = static_cast<std::uint32_t>(contacts.size());
    }
    /// Forces of the last step before a look at the water, a sample or a saved state.
    PairForces& last(std::size_t pair) { return last_[pair]; }
    /// May touch in the next step, or touched at the last look.
    bool is_near(std::size_t pair) const { return pairs_[pair].candidates > 0 || last_[pair].is_acting(); }
    /// Those that touch, in order.
    std::vector<TouchingPair> touching() const;
    std::size_t contact_count() const;
    /// Asks for the memory of a pair that will soon be evaluated.
    void fetch(std::size_t pair) const;

    /// Pairs of one block, as 2 * pair + (1 where the block is the partner), ascending.
    std::span<const std::uint32_t> pairs_of(std::size_t block) const {
        return {incidence_.data() + incidence_begin_[block], incidence_.data() + incidence_begin_[block + 1]};
    }
    bool is_block(std::uint32_t partner) const { return partner < blocks_.size(); }
    bool is_fixed_spheres(std::uint32_t partner) const { return partner == blocks_.size(); }
    const Plane& plane(std::uint32_t partner) const {
        return surroundings_.planes[partner - blocks_.size() - 1];
    }
    /// Puts back the contacts of a saved run; every pair they name must be listed (it is: they touch).
    void restore(const std::vector<TouchingPair>& saved);
    /// Everything is found again from the present poses.
    void rebuild();
    /// Pairs whose candidates were found so far.
    std::uint64_t searches() const { return searches_; }

 private:
    /// How far a block may go before its candidates are found again, m.
    struct Freedom {
        double left, whole;
    };
    /// What pairs hold, an entry for each candidate; candidates and contacts of a pair begin at one place.
    struct Held {
        std::vector<Candidate> candidates;
        std::vector<Vector> centres;
        std::vector<Contact> contacts;

        std::size_t size() const { return candidates.size(); }
        void resize(std::size_t size);
    };
    void look_closer(std::uint32_t block, double way);
    void find_pairs();
    bool search(std::size_t pair);
    void find_candidates(const Pair& pair);
    void find_block_candidates(const Pair& pair);
    void find_incidence();
    void make_room(Pair& pair, std::size_t room);
    void lay_in_order();
    /// How far apart the surfaces of a pair may be while its candidates hold, m: the block goes as far as it
    /// may, the partner from one end of its freedom to the other, or the other way round.
    double reach_of(const Pair& pair) const {
        const double own = freedom_[pair.block].whole;
        if (!is_block(pair.partner)) return own;
        const double other = freedom_[pair.partner].whole;
        return own + other + std::max(own, other);
    }
    /// The farthest point goes at most |dx| + 2 R sin(angle/2), and |vec(q0* q)| is sin(angle/2).
    double moved_since(std::size_t block, const std::vector<Vector>& position,
                       const std::vector<Quaternion>& orientation) const {
        const double turned = (orientation[block].conjugate() * blocks_.orientation[block]).vec().norm();
        return (blocks_.position[block] - position[block]).norm() +
               2 * blocks_.shape_of(block).radius * turned;
    }

    const Blocks& blocks_;
    const Surroundings& surroundings_;
    double most_freedom_, wide_skin_;
    std::vector<Pair> pairs_;
    std::vector<PairForces> last_;  // in step with pairs_
    Held held_;
    std::size_t moved_ = 0;  // pairs that stand out of order in held_
    std::vector<std::uint32_t> incidence_, incidence_begin_;
    std::vector<Freedom> freedom_;
    std::vector<Vector> narrow_position_, wide_position_;
    std::vector<Quaternion> narrow_orientation_, wide_orientation_;
    std::vector<std::uint32_t> stale_, near_a_, near_b_;
    std::vector<double> stale_way_;  // in step with stale_
    std::vector<FixedSpheres::Near> near_;
    std::vector<Candidate> found_;
    std::vector<Vector> found_centres_, centres_b_;
    std::uint64_t searches_ = 0;
};

}  // namespace dem
