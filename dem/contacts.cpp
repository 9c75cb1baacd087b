#include "dem/contacts.hpp"

#include <algorithm>
#include <cmath>

#include "common/parallel.hpp"
#include "dem/contact_laws.hpp"

namespace dem {

namespace {

/// Two spheres that overlap, as geometry has it.
struct Touch {
    std::uint32_t a, b;
    double overlap;  // m
    Vector normal;   // from the block to the partner
    Vector arm;      // from the block's centre to the middle of the contact
};

/// Centre of the partner seen from that of the block; nothing for bodies that do not move.
Vector partner_from_block(const Blocks& blocks, const Surroundings& surroundings, const PairList& list,
                          const Pair& pair) {
    if (!list.is_block(pair.partner)) return Vector(0, 0, 0);
    Vector offset = blocks.position[pair.partner] - blocks.position[pair.block];
    offset.y() += pair.image * surroundings.period;
    return offset;
}

/// The touching spheres of a pair, in order of candidates, appended to `touches`.
void find_touches(const Blocks& blocks, const Surroundings& surroundings, const PairList& list,
                  const Pair& pair, std::vector<Touch>& touches) {
    const Shape& shape = blocks.shape_of(pair.block);
    const Rotation& turn = blocks.rotation[pair.block];
    const Vector& centre = blocks.position[pair.block];
    const double radius = 0.5 * shape.diameter;

    // `share`: the partner's part of the reach.
    const auto add = [&](const Candidate& candidate, const Vector& arm, const Vector& between, double squared,
                         double reach, double share) {
        const double distance = std::sqrt(squared);
        const double overlap = reach - distance;
        // Two centres at one place (a user's start) have no normal; up is as good as any.
        const Vector normal = distance > 0 ? Vector(between * (1 / distance)) : Vector(0, 0, -1);
        touches.push_back(
            {candidate.a, candidate.b, overlap, normal, arm + (radius - overlap * share) * normal});
    };

    if (list.is_block(pair.partner)) {
        const Shape& other = blocks.shape_of(pair.partner);
        const Rotation& other_turn = blocks.rotation[pair.partner];
        const Vector offset = partner_from_block(blocks, surroundings, list, pair);
        const double reach = radius + 0.5 * other.diameter, share = 0.5 * other.diameter / reach;
        for (const auto& candidate : list.candidates(pair)) {
            const Vector arm = turn * shape.spheres[candidate.a];
            const Vector between = offset + other_turn * other.spheres[candidate.b] - arm;
            const double squared = between.squaredNorm();
            if (squared < reach * reach) add(candidate, arm, between, squared, reach, share);
        }
    } else if (list.is_fixed_spheres(pair.partner)) {
        const double partner_radius = 0.5 * surroundings.fixed_spheres.diameter();
        const double reach = radius + partner_radius, share = partner_radius / reach;
        const auto candidates = list.candidates(pair);
        const auto centres = list.centres(pair);
        for (std::size_t k = 0; k < candidates.size(); ++k) {
            const Candidate& candidate = candidates[k];
            const Vector arm = turn * shape.spheres[candidate.a];
            const Vector between = centres[k] - centre - arm;
            const double squared = between.squaredNorm();
            if (squared < reach * reach) add(candidate, arm, between, squared, reach, share);
        }
    } else {
        const Plane& plane = list.plane(pair.partner);
        const double height = (centre - plane.point).dot(plane.normal);
        for (const auto& candidate : list.candidates(pair)) {
            const Vector arm = turn * shape.spheres[candidate.a];
            const double overlap = radius - height - arm.dot(plane.normal);
            if (overlap <= 0) continue;
            touches.push_back({candidate.a, candidate.b, overlap, -plane.normal,
                               arm - (radius - 0.5 * overlap) * plane.normal});
        }
    }
}

/// R* of a pair's spheres, m.
double reduced_radius(const Blocks& blocks, const Surroundings& surroundings, const PairList& list,
                      const Pair& pair) {
    const double radius = 0.5 * blocks.shape_of(pair.block).diameter;
    if (list.is_block(pair.partner)) {
        const double other = 0.5 * blocks.shape_of(pair.partner).diameter;
        return radius * other / (radius + other);
    }
    if (list.is_fixed_spheres(pair.partner)) {
        const double other = 0.5 * surroundings.fixed_spheres.diameter();
        return radius * other / (radius + other);
    }
    return radius;
}

/// Mass of the two-body system, kg.
double reduced_mass(const Blocks& blocks, const PairList& list, const Pair& pair) {
    const bool partner_moves = list.is_block(pair.partner) && !blocks.is_fixed[pair.partner];
    if (!partner_moves) return blocks.mass(pair.block);
    const double mass = blocks.mass(pair.partner);
    if (blocks.is_fixed[pair.block]) return mass;
    return mass * blocks.mass(pair.block) / (mass + blocks.mass(pair.block));
}

template <class Law, class Friction>
class PairwiseContacts final : public ContactModel {
 public:
    PairwiseContacts(Law law, Friction friction, double damping_ratio)
        : law_(law), friction_(friction), damping_ratio_(damping_ratio) {}

    void evaluate(const Blocks& blocks, const Surroundings& surroundings, PairList& list,
                  std::span<const std::uint32_t> active, double dt,
                  std::span<PairForces> forces) const override {
        constexpr std::size_t serial_below =
            2000;  // pairs; waking threads costs as much as a few hundred of them
        common::parallel_for(active.size(), serial_below, [&](std::size_t k) {
            // Thousands of pairs do not stay in the near caches: waiting for them one by one took longer than
            // the arithmetic.
            constexpr std::size_t ahead = 4;
            if (k + ahead < active.size()) list.fetch(active[k + ahead]);
            evaluate_pair(blocks, surroundings, list, active[k], dt, forces[k]);
        });
    }

    double elastic_energy(const Blocks& blocks, const Surroundings& surroundings,
                          const PairList& list) const override {
        double energy = 0;
        std::vector<Touch> touches;
        for (const auto& pair : list.pairs()) {
            touches.clear();
            find_touches(blocks, surroundings, list, pair, touches);
            const double radius = reduced_radius(blocks, surroundings, list, pair);
            for (const auto& touch : touches)
                energy += law_.energy(law_.stiffness(radius, touch.overlap), touch.overlap);
            for (const auto& contact : list.contacts(pair))
                energy += friction_.energy(contact.spring, contact.stiffness);
        }
        return energy;
    }

    void carry(const Blocks& blocks, const Surroundings& surroundings, const PairList& list, const Pair& pair,
               bool as_partner, std::vector<CarriedContact>& contacts) const override {
        std::vector<Touch> touches;
        find_touches(blocks, surroundings, list, pair, touches);
        const double radius = reduced_radius(blocks, surroundings, list, pair), side = as_partner ? -1 : 1;
        const Vector centre =
            as_partner ? partner_from_block(blocks, surroundings, list, pair) : Vector::Zero();
        for (const auto& touch : touches) {
            const double force = law_.force(law_.stiffness(radius, touch.overlap), touch.overlap);
            const auto same = [&](const Contact& held) { return held.a == touch.a && held.b == touch.b; };
            const auto held = list.contacts(pair);
            const auto found = std::find_if(held.begin(), held.end(), same);
            contacts.push_back({touch.arm - centre, side * touch.normal, force,
                                found == held.end() ? Vector::Zero() : Vector(side * found->spring)});
        }
    }

    double tangential_ratio() const override { return friction_.ratio(); }
    double friction() const override { return friction_.coefficient_or_none(); }

    double damping_coefficient(double mass, std::size_t count, double stiffness) const override {
        return damping_scale(mass, count) * std::sqrt(stiffness);
    }

 private:
    /// Dashpot over the square root of the stiffness.
    double damping_scale(double mass, std::size_t count) const {
        return 2 * damping_ratio_ * std::sqrt(mass / static_cast<double>(count));
    }

    void evaluate_pair(const Blocks& blocks, const Surroundings& surroundings, PairList& list,
                       std::size_t index, double dt, PairForces& forces) const {
        const Pair& pair = list.pairs()[index];
        thread_local std::vector<Touch> touches;
        thread_local std::vector<Contact> now;
        touches.clear();
        find_touches(blocks, surroundings, list, pair, touches);
        if (touches.empty()) {
            list.set_contacts(index, {});
            return;
        }
        const bool partner_is_block = list.is_block(pair.partner);
        const double radius = reduced_radius(blocks, surroundings, list, pair);
        const double damping = damping_scale(reduced_mass(blocks, list, pair), touches.size());
        // Velocity of the block relative to the partner at `arm`: v_a - v_b + w_b x offset + (w_a - w_b) x
        // arm.
        const Vector offset = partner_from_block(blocks, surroundings, list, pair);
        Vector approach = blocks.velocity[pair.block], spin = blocks.angular_velocity[pair.block];
        Vector mean_turn = 0.5 * dt * spin;
        if (partner_is_block) {
            mean_turn += 0.5 * dt * blocks.angular_velocity[pair.partner];
            approach += blocks.angular_velocity[pair.partner].cross(offset) - blocks.velocity[pair.partner];
            spin -= blocks.angular_velocity[pair.partner];
        }
        // Slower than 1e-8 rad/s at 1e-4 s nothing turns that matters: blocks at rest need not turn their
        // springs.
        const bool turns = mean_turn.squaredNorm() > 1e-24;
        Vector elastic_force = Vector::Zero(), elastic_torque = Vector::Zero();
        Vector damping_force = Vector::Zero(), damping_torque = Vector::Zero();
        double dissipated = 0, largest_overlap = 0;

        now.clear();
        const auto before = list.contacts(pair);
        auto earlier = before.begin();
        for (const auto& touch : touches) {
            const double stiffness = law_.stiffness(radius, touch.overlap);
            Contact contact{touch.a, touch.b, stiffness, Vector::Zero()};
            double stiffness_before = stiffness;
            while (earlier != before.end() &&
                   (earlier->a < touch.a || (earlier->a == touch.a && earlier->b < touch.b)))
                ++earlier;
            if (earlier != before.end() && earlier->a == touch.a && earlier->b == touch.b) {
                contact.spring = earlier->spring;
                stiffness_before = earlier->stiffness;
            }

            const Vector relative = approach + spin.cross(touch.arm);
            const double closing_speed = relative.dot(touch.normal);
            const double elastic = law_.force(stiffness, touch.overlap);
            const double dashpot = damping * std::sqrt(stiffness);
            // No tension: the dashpot never pulls.
            const double normal_force = std::max(0.0, elastic + dashpot * closing_speed);
            const Vector slip_speed = relative - closing_speed * touch.normal;
            const TangentialForce tangential =
                friction_.force(contact.spring, stiffness_before, stiffness, touch.normal, slip_speed,
                                normal_force, dashpot, turns ? mean_turn.dot(touch.normal) : 0.0, dt);
            const Vector springs = contact.spring - elastic * touch.normal;
            const Vector dashpots = tangential.dashpot - (normal_force - elastic) * touch.normal;
            elastic_force += springs;
            elastic_torque += touch.arm.cross(springs);
            damping_force += dashpots;
            damping_torque += touch.arm.cross(dashpots);
            dissipated += tangential.dissipated;
            largest_overlap = std::max(largest_overlap, touch.overlap);
            now.push_back(contact);
        }
        forces = {.force = elastic_force + damping_force,
                  .torque_on_block = elastic_torque + damping_torque,
                  .offset = offset,
                  .damping_force = damping_force,
                  .damping_torque = damping_torque,
                  .dissipated = dissipated,
                  .largest_overlap = largest_overlap};
        list.set_contacts(index, now);
    }

    Law law_;
    Friction friction_;
    double damping_ratio_;
};

template <class Law>
std::unique_ptr<ContactModel> with_friction(const Law& law, const Material& material) {
    if (material.friction > 0)
        return std::make_unique<PairwiseContacts<Law, CoulombFriction>>(law, CoulombFriction(material),
                                                                        material.damping_ratio);
    return std::make_unique<PairwiseContacts<Law, Frictionless>>(law, Frictionless{}, material.damping_ratio);
}

}  // namespace

std::unique_ptr<ContactModel> make_contact_model(ContactLaw law, const Material& material,
                                                 double element_diameter, double reference_overlap) {
    if (law == ContactLaw::hertz) return with_friction(HertzLaw(material), material);
    return with_friction(LinearLaw(material, element_diameter, reference_overlap), material);
}

}  // namespace dem
