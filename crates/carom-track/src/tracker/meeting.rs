//! What happens at a wall.

#![allow(clippy::needless_range_loop, reason = "one index runs through several arrays of lanes or components")]

use super::contact::{Contact, Ending};
use super::crew::Crew;
use super::lane::{Lane, trace};
use super::walk::finish;
use super::wall_jet::leave;
use super::{Behavior, Particle, Walk};
use crate::domain::{Domain, Hit, Pieces};
use crate::dynamics::Bodies;
use crate::force::brownian::BOLTZMANN;
use crate::random::{Purpose, Stream};
use crate::record::{Event, ImpactRecord, ParticleFate, Sink};
use crate::vector::{Vec3, add, cross, dot, norm, scale, sub};
use carom::normal::NormalLaw;
use carom::{Energy, Fate, Impact, Validity, WallLaw};

/// Impacts in a row without any time between them after which a sphere is wedged between walls and stays.
const WEDGED: u32 = 64;
/// Least height of a bounce that counts, over the radius.
pub(super) const LOWEST: f64 = 1e-9;
/// Time that is none, over the time since the start: some 50 units in its last place.
pub(super) const NO_TIME: f64 = 1e-14;

/// What an impact leaves.
pub(super) struct After {
    pub event: Event,
    pub velocity: Vec3,
    pub spin: Vec3,
    pub restitution: f64,
    pub impulse_ratio: f64,
    pub energy: Energy,
    pub validity: Validity,
    /// A bounce of a wall law, which may be the last.
    pub bounces: bool,
}

impl<D: Domain> Walk<'_, D> {
    /// Ends a step at a wall, where the sphere arrives with velocity `v`.
    #[inline(always)]
    pub(super) fn meet<const W: usize>(
        &self,
        crew: &mut Crew<W, D::Many<W>>,
        l: usize,
        hit: &Hit,
        v: Vec3,
        sink: &mut dyn Sink,
    ) {
        let theta = hit.meeting.theta;
        let h = crew.h[l];
        if crew.lanes[l].trace {
            trace(crew, l, theta, sink);
        }
        let spin = self.spin_at(crew, l, theta);
        crew.time[l] += theta * h;
        crew.next[l] = if theta > 0.1 { h } else { h * (4.0 * theta).max(1e-3) };
        self.begin_anew(crew, l);
        let lane = &mut crew.lanes[l];
        lane.fitted = false;
        lane.standing = if theta * h > NO_TIME * crew.time[l] { 0 } else { lane.standing + 1 };
        lane.impacts += 1;
        if lane.trace {
            sink.point(lane.particle.number, crew.time[l], hit.meeting.position, v, spin);
        }
        let mut after = self.outcome(crew, l, hit, v, spin);
        put(crew, l, hit.meeting.position, after.velocity, after.spin);
        let (mut contact, mut pressed) = (None::<Contact<'_, D>>, false);
        if after.event == Event::Rebound {
            if self.has_chance() {
                self.renew(crew, l, theta * h);
            }
            if after.bounces && (crew.lanes[l].standing > WEDGED || self.settles(crew, l, hit, &after)) {
                contact = self.begin_contact(crew, l, hit, &mut after);
                put(crew, l, hit.meeting.position, after.velocity, after.spin);
            } else {
                let eddies = self.dynamics.random_walk.is_some();
                pressed = after.bounces && eddies && self.is_pressed_by_chance(crew, l, hit, &after);
            }
        }
        let is_held = matches!(after.event, Event::Capture | Event::Settle);
        if is_held && let Some(mode) = self.removes(crew, l, hit) {
            (after.velocity, after.spin) = (hit.wall_velocity, [0.0; 3]);
            contact = self.rolls_off(crew, l, hit, &after, mode);
            // where it is followed the impact is no end, nor is a removal counted
            after.event = if contact.is_some() { Event::Rebound } else { Event::Remove(mode) };
        }
        sink.impact(&record(&crew.lanes[l], crew.time[l], hit, v, spin, &after));
        if let Some(fate) = after.event.ends() {
            finish(crew, l, fate, Some(hit.wall), sink);
        } else if let Some(contact) = contact {
            self.stay(crew, l, contact, sink);
        } else if pressed {
            self.follow_pressed(crew, l, hit, &after, sink);
        }
    }

    /// What a sphere does whose bounce dies: it stays where it is, flies on, or begins its contact motion.
    #[inline(never)]
    fn begin_contact<'b, const W: usize>(
        &'b self,
        crew: &Crew<W, D::Many<W>>,
        l: usize,
        hit: &Hit,
        after: &mut After,
    ) -> Option<Contact<'b, D>> {
        let mut begun = self.contact(crew, l, hit, after);
        let standing = crew.lanes[l].standing;
        match begun.begin() {
            Some(Ending::Rests) => after.rest(hit),
            // the criterion of incipient motion says which way: taken off, or held by adhesion
            _ if matches!(self.behaviors.get(hit.wall), Some(Behavior::Removal(..))) => after.rest(hit),
            // wedged: no time passes, whatever it does
            Some(_) if standing > WEDGED => after.rest(hit),
            None if standing > 2 * WEDGED => after.rest(hit),
            Some(_) => {}
            None => return Some(begun),
        }
        None
    }

    #[inline(always)]
    pub(super) fn outcome<const W: usize>(
        &self,
        crew: &Crew<W, D::Many<W>>,
        l: usize,
        hit: &Hit,
        v: Vec3,
        spin: Vec3,
    ) -> After {
        let lane = &crew.lanes[l];
        let n = hit.meeting.normal;
        let stay = |event| After {
            event,
            velocity: hit.wall_velocity,
            spin: [0.0; 3],
            restitution: 0.0,
            impulse_ratio: f64::NAN,
            energy: Energy::default(),
            validity: Validity::NONE,
            bounces: false,
        };
        let Some(behavior) = self.behaviors.get(hit.wall) else {
            debug_assert!(false, "Tracker::run asked for a behavior of each wall");
            return stay(Event::Trap);
        };
        let law = match behavior {
            Behavior::Trap => return stay(Event::Trap),
            Behavior::Escape => return After { velocity: v, spin, restitution: f64::NAN, ..stay(Event::Escape) },
            Behavior::WallJet => {
                let event = u32::try_from(lane.impacts).unwrap_or(u32::MAX);
                let mut draws = Stream::new(self.settings.seed, lane.particle.number, Purpose::Wall, event);
                let Some(out) = leave(sub(v, hit.wall_velocity), n, draws.uniforms()) else {
                    return stay(Event::Settle);
                };
                let velocity = add(out, hit.wall_velocity);
                return After { velocity, spin, restitution: f64::NAN, ..stay(Event::Rebound) };
            }
            Behavior::Law(_) | Behavior::Removal(..) => law_of(behavior, lane.particle.injection),
        };
        let Some(law) = law else {
            debug_assert!(false, "Tracker::run asked for a law of each injection");
            return stay(Event::Trap);
        };
        let Particle { diameter, density, .. } = lane.particle;
        let draws = || {
            let event = u32::try_from(lane.impacts).unwrap_or(u32::MAX);
            Stream::new(self.settings.seed, lane.particle.number, Purpose::Wall, event).uniforms()
        };
        let impact = Impact {
            diameter,
            density: Some(density),
            velocity: v,
            spin,
            normal: n,
            wall_velocity: hit.wall_velocity,
            draws: if law.scatter().is_some() { draws() } else { [0.5; 4] },
        };
        let Ok(out) = law.impact(&impact) else {
            // pressed against the wall without approaching it
            if is_held_at_rest(law, &impact) {
                return stay(Event::Capture);
            }
            let relative = sub(v, hit.wall_velocity);
            let along = sub(relative, scale(n, dot(relative, n)));
            let kept = if norm(along) > 0.0 { 1.0 } else { 0.0 };
            return After {
                bounces: true,
                velocity: add(along, hit.wall_velocity),
                spin,
                energy: Energy::without_mechanism(0.0, 0.0, kept),
                ..stay(Event::Rebound)
            };
        };
        if out.fate == Fate::Capture
            && let Some(after) = glance(law, &impact, &out)
        {
            return after;
        }
        After {
            bounces: true,
            event: if out.fate == Fate::Capture { Event::Capture } else { Event::Rebound },
            velocity: out.velocity,
            spin: out.spin,
            restitution: out.restitution,
            impulse_ratio: out.impulse_ratio,
            energy: out.energy,
            validity: out.validity,
        }
    }

    /// Would the next bounce rise less than the stated height? The steady forces alone press.
    #[inline(always)]
    fn settles<const W: usize>(&self, crew: &Crew<W, D::Many<W>>, l: usize, hit: &Hit, after: &After) -> bool {
        let n = hit.meeting.normal;
        let up = dot(sub(after.velocity, hit.wall_velocity), n);
        let limit = 2.0 * self.settings.settle_height.of(crew.bodies.radius[l]);
        let along = sub(after.velocity, scale(n, up));
        let (here, x) = ((crew.here.get(l), crew.time[l]), hit.meeting.position);
        // a bound first, which costs no power
        let bound = || self.dynamics.press_at_most(self.domain, here, (&crew.bodies, l), x, along, n);
        !(up > 0.0 && up * up >= limit * bound().max(0.0)) && self.is_pressed_steadily(crew, l, hit, after)
    }

    /// The same, asked of the forces: few bounces are so low.
    #[inline(never)]
    fn is_pressed_steadily<const W: usize>(
        &self,
        crew: &Crew<W, D::Many<W>>,
        l: usize,
        hit: &Hit,
        after: &After,
    ) -> bool {
        let height = self.settings.settle_height.of(crew.bodies.radius[l]);
        let body = Bodies { eddy: [None], ..crew.bodies.one(l) };
        let (up, press) = self.pressed(crew, l, &body, hit, after);
        if self.dynamics.brownian && press * height <= self.thermal_energy(&body) {
            // the molecules lift it higher than that again
            return false;
        }
        let here = (crew.here.get(l), crew.time[l]);
        if press <= self.eddies_lift(here, &body, hit.meeting.position, hit.meeting.normal) {
            return false;
        }
        if up <= 0.0 { press > 0.0 } else { up * up < 2.0 * height * press }
    }

    /// Would the next bounce rise to no height that counts, as the present eddy pushes?
    #[inline(never)]
    fn is_pressed_by_chance<const W: usize>(
        &self,
        crew: &Crew<W, D::Many<W>>,
        l: usize,
        hit: &Hit,
        after: &After,
    ) -> bool {
        let radius = crew.bodies.radius[l];
        let height = self.settings.settle_height.of(radius).max(LOWEST * radius);
        let body = crew.bodies.one(l);
        let (up, press) = self.pressed(crew, l, &body, hit, after);
        if self.dynamics.brownian && press * height <= self.thermal_energy(&body) {
            return false;
        }
        press > 0.0 && up * up < 2.0 * height * press
    }

    /// The speed at which a sphere leaves a wall, m/s, and the acceleration with which the forces on it as `body` press it back, m/s².
    fn pressed<const W: usize>(
        &self,
        crew: &Crew<W, D::Many<W>>,
        l: usize,
        body: &Bodies<1>,
        hit: &Hit,
        after: &After,
    ) -> (f64, f64) {
        let n = hit.meeting.normal;
        let up = dot(sub(after.velocity, hit.wall_velocity), n);
        let along = sub(after.velocity, scale(n, up));
        let here = (crew.here.get(l), crew.time[l]);
        let a = self.rates_at(here, body, hit.meeting.position, along, after.spin).a;
        (up, -(n[0] * a[0][0] + n[1] * a[1][0] + n[2] * a[2][0]))
    }

    /// The acceleration with which eddies of the usual strength lift a sphere off a wall, m/s².
    fn eddies_lift(&self, (here, time): (D::Here, f64), body: &Bodies<1>, x: Vec3, normal: Vec3) -> f64 {
        let Some(walk) = &self.dynamics.random_walk else { return 0.0 };
        let local = self.domain.fluid(here, time, x);
        let fluid = self.dynamics.fluid_at(&local);
        let gust = walk.fluctuation(normal, &local, fluid.kinematic_viscosity());
        dot(gust, normal).max(0.0) * (1.0 / self.dynamics.relaxation_time_in(&fluid, &body.sphere[0]))
    }

    /// k T per mass, m²/s².
    fn thermal_energy(&self, body: &Bodies<1>) -> f64 {
        BOLTZMANN * self.dynamics.fluid.temperature / body.sphere[0].mass()
    }
}

/// What is left of an impact on a wall whose given restitution is zero: the motion along it.
#[inline(never)]
fn glance(law: &WallLaw, impact: &Impact, out: &carom::Outcome) -> Option<After> {
    let NormalLaw::Table(_) = law.normal() else { return None };
    let n = impact.normal;
    let relative = sub(impact.velocity, impact.wall_velocity);
    let v_n = -dot(relative, n);
    let tangent = add(relative, scale(n, v_n));
    let radius = 0.5 * impact.diameter;
    let slip = sub(tangent, scale(cross(impact.spin, n), radius));
    let (speed, slipping) = (norm(tangent), norm(slip));
    let (velocity, spin) = match law.given_tangential_restitution(v_n, speed) {
        Some(e_t) => (scale(tangent, e_t), impact.spin),
        // an impact of a friction law without a rebound: the slip ends, or the normal impulse does not suffice
        None if slipping > 0.0 => {
            let impulse = (law.tangential().friction()? * v_n).min(2.0 / 7.0 * slipping);
            let direction = scale(slip, 1.0 / slipping);
            let turn = scale(cross(n, direction), 2.5 * impulse / radius);
            (sub(tangent, scale(direction, impulse)), add(impact.spin, turn))
        }
        None => (tangent, impact.spin),
    };
    let energy = |v: Vec3, spin: Vec3| dot(v, v) + 0.4 * radius * radius * dot(spin, spin);
    let (before, kept) = (energy(relative, impact.spin), energy(velocity, spin));
    let across = v_n * v_n / before;
    let kept = kept / before;
    Some(After {
        bounces: true,
        event: Event::Rebound,
        velocity: add(velocity, impact.wall_velocity),
        spin,
        restitution: 0.0,
        impulse_ratio: norm(sub(tangent, velocity)) / v_n,
        energy: Energy::without_mechanism(across, (1.0 - across - kept).max(0.0), kept),
        validity: out.validity,
    })
}

impl After {
    /// It stays where it hit.
    fn rest(&mut self, hit: &Hit) {
        (self.event, self.velocity, self.spin) = (Event::Settle, hit.wall_velocity, [0.0; 3]);
    }
}

/// The law of a wall for the spheres of an injection.
#[inline(always)]
pub(super) fn law_of(behavior: &Behavior, injection: usize) -> Option<&WallLaw> {
    match behavior.laws()? {
        [one] => Some(one),
        each => each.get(injection),
    }
}

/// Whether adhesion holds a sphere that touches a wall at rest: if the law captures at the slowest approach.
fn is_held_at_rest(law: &WallLaw, impact: &Impact) -> bool {
    const SLOWEST: f64 = 1e-9;
    let approaching =
        Impact { velocity: sub(impact.wall_velocity, scale(impact.normal, SLOWEST)), spin: [0.0; 3], ..*impact };
    let captures = law.impact(&approaching).is_ok_and(|out| out.fate == Fate::Capture);
    captures && !matches!(law.normal(), NormalLaw::Table(_))
}

#[inline(always)]
pub(super) fn put<const W: usize, P>(crew: &mut Crew<W, P>, l: usize, x: Vec3, v: Vec3, spin: Vec3) {
    for c in 0..3 {
        crew.motion.x[c][l] = x[c];
        crew.motion.v[c][l] = v[c];
        crew.motion.spin[c][l] = spin[c];
    }
    crew.stale[l] = true;
}

/// Speeds and spin before and after, relative to the wall. Spin is positive when it rolls forward along the tangential
/// velocity (the outgoing one where there is none coming in).
#[inline(always)]
pub(super) fn record(lane: &Lane, time: f64, hit: &Hit, v: Vec3, spin: Vec3, after: &After) -> ImpactRecord {
    let n = hit.meeting.normal;
    let split = |v: Vec3| {
        let rel = sub(v, hit.wall_velocity);
        let up = dot(rel, n);
        (up, sub(rel, scale(n, up)))
    };
    let (up_in, along_in) = split(v);
    let (up_out, along_out) = split(after.velocity);
    let forward = [along_in, along_out].into_iter().find(|t| norm(*t) > 0.0);
    let rolling = forward.map(|t| scale(cross(n, t), 1.0 / norm(t)));
    let roll = |spin: Vec3| rolling.map_or(norm(spin), |axis| dot(spin, axis));
    ImpactRecord {
        particle: lane.particle.number,
        time,
        position: hit.meeting.position,
        normal: n,
        wall: hit.wall,
        face: hit.face,
        diameter: lane.particle.diameter,
        weight: lane.particle.weight,
        normal_speed_in: (-up_in).max(0.0),
        tangential_speed_in: norm(along_in),
        spin_in: roll(spin),
        restitution: after.restitution,
        impulse_ratio: after.impulse_ratio,
        event: after.event,
        normal_speed_out: if after.event == Event::Escape { -up_out } else { up_out },
        tangential_speed_out: norm(along_out),
        spin_out: roll(after.spin),
        energy: after.energy,
        validity: after.validity,
    }
}

impl Event {
    /// The fate of a particle that this ends.
    pub fn ends(self) -> Option<ParticleFate> {
        match self {
            Self::Rebound | Self::RollOff | Self::SlideOff | Self::LiftOff => None,
            Self::Capture => Some(ParticleFate::Captured),
            Self::Settle => Some(ParticleFate::Settled),
            Self::Trap => Some(ParticleFate::Trapped),
            Self::Escape => Some(ParticleFate::Escaped),
            Self::Remove(_) => Some(ParticleFate::Removed),
        }
    }
}
