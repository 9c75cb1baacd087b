/// Contact forces between spheres: springs and dashpots from Hertz theory, Coulomb friction with history, no
/// tension.
///
/// Dashpots: critical damping of the two blocks as bodies, c = 2 zeta sqrt(k m), m their reduced mass. Two
/// flat faces touch in many sphere pairs at once; each dashpot is divided by the square root of the number n
/// of touching spheres of that pair of bodies, so that n of them together damp the n springs together as
/// asked (n c = 2 zeta sqrt(n k m)).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "dem/blocks.hpp"
#include "dem/effects/reserve.hpp"
#include "dem/material.hpp"
#include "dem/pair_list.hpp"

namespace dem {

/// Evaluates pairs of one contact law.
class ContactModel {
 public:
    virtual ~ContactModel() = default;
    /// Forces of the given pairs, in `forces` one for each; contact histories go on by `dt`. A pair that does
    /// not touch is left without contacts, and its forces are not set.
    virtual void evaluate(const Blocks& blocks, const Surroundings& surroundings, PairList& list,
                          std::span<const std::uint32_t> active, double dt,
                          std::span<PairForces> forces) const = 0;
    /// Energy stored in normal and tangential springs at the present poses, J.
    virtual double elastic_energy(const Blocks& blocks, const Surroundings& surroundings,
                                  const PairList& list) const = 0;
    /// Appends the contacts of a touching pair as its block feels them, or its partner.
    virtual void carry(const Blocks& blocks, const Surroundings& surroundings, const PairList& list,
                       const Pair& pair, bool as_partner, std::vector<CarriedContact>& contacts) const = 0;
    /// Tangential over normal stiffness; 0 without friction.
    virtual double tangential_ratio() const = 0;
    /// mu; 0 without friction.
    virtual double friction() const = 0;
    /// Normal dashpot of one of `count` contacts between two bodies of reduced mass `mass`, kg/s.
    virtual double damping_coefficient(double mass, std::size_t count, double stiffness) const = 0;
};

enum class ContactLaw { hertz, linear };

/// `reference_overlap` (m): where the linear law takes its stiffness from Hertz theory. Without friction (mu
/// = 0) the tangential law is absent.
std::unique_ptr<ContactModel> make_contact_model(ContactLaw law, const Material& material,
                                                 double element_diameter, double reference_overlap);

}  // namespace dem
