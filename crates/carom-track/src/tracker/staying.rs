//! How a lane goes into contact motion and out of it: its rows, its impacts on other walls, its fate.

use super::Walk;
use super::contact::{Contact, Ending, Motion};
use super::crew::Crew;
use super::lane::Lane;
use super::meeting::{After, put, record};
use super::walk::{finish, lose};
use crate::domain::{Domain, Hit, Pieces};
use crate::geometry::Meeting;
use crate::record::{Event, ParticleFate, Sink};
use crate::vector::{Vec3, dot, norm, sub};
use carom::{Energy, Validity};

/// Impacts on other walls during one contact motion after which a sphere is wedged between them.
const WEDGED: u32 = 10_000;

impl<D: Domain> Walk<'_, D> {
    /// The contact motion of a lane whose bounce dies.
    pub(super) fn contact<'b, const W: usize>(
        &'b self,
        crew: &Crew<W, D::Many<W>>,
        l: usize,
        hit: &Hit,
        after: &After,
    ) -> Contact<'b, D> {
        let motion = Motion { x: hit.meeting.position, v: after.velocity, spin: after.spin };
        let place = (crew.here.get(l), crew.time[l]);
        let injection = crew.lanes[l].particle.injection;
        let (wall, normal) = (hit.wall, hit.meeting.normal);
        Contact::new(*self, crew.bodies.one(l), injection, place, motion, wall, normal, crew.steps[l])
    }

    /// Follows a lane's contact motion to its end.
    #[inline(never)]
    pub(super) fn stay<const W: usize>(
        &self,
        crew: &mut Crew<W, D::Many<W>>,
        l: usize,
        mut contact: Contact<'_, D>,
        sink: &mut dyn Sink,
    ) {
        let began = (contact.time, contact.motion);
        let mut blows = 0;
        let (event, fate) = loop {
            let (number, traced) = (crew.lanes[l].particle.number, crew.lanes[l].trace);
            let trace = |time: f64, m: &Motion| {
                if traced {
                    sink.point(number, time, m.x, m.v, m.spin);
                }
            };
            let ending = contact.run(trace);
            self.bring(crew, l, &contact, sink);
            match ending {
                Ending::Rests => break (Some(Event::Settle), Some(ParticleFate::Settled)),
                Ending::TimeIsUp => break (None, Some(ParticleFate::Sliding)),
                Ending::Stalls => {
                    sink.stalled();
                    break (None, Some(ParticleFate::Sliding));
                }
                Ending::Leaves(event) => break (Some(event), None),
                Ending::Lost(cell) => {
                    crew.lanes[l].lost_from = cell;
                    break (None, Some(ParticleFate::Stuck));
                }
                Ending::Meets(hit) => {
                    blows += 1;
                    let off = contact.left_by();
                    let (before, after, stays) = self.strike(crew, l, &mut contact, &hit);
                    let ends = after.event.ends();
                    let wedged = blows > WEDGED;
                    if ends.is_some() || !(stays || wedged) {
                        self.end_row(crew, l, &contact, (began.1, before), off, sink);
                    }
                    self.struck(crew, l, &hit, &before, &after, sink);
                    match ends {
                        Some(fate) => return finish(crew, l, fate, Some(hit.wall), sink),
                        None if wedged => break (Some(Event::Settle), Some(ParticleFate::Settled)),
                        None if !stays => return self.fly_on(crew, l, began.0),
                        None => {}
                    }
                }
            }
        };
        let wall = contact.wall;
        if fate == Some(ParticleFate::Settled) {
            let velocity = self.domain.walls().list().get(wall).map_or([0.0; 3], |w| w.velocity);
            put(crew, l, contact.place(), velocity, [0.0; 3]);
        }
        if let Some(event) = event {
            self.end_row(crew, l, &contact, (began.1, contact.motion), event, sink);
        }
        match fate {
            Some(fate) => finish(crew, l, fate, (fate != ParticleFate::Stuck).then_some(wall), sink),
            None => self.fly_on(crew, l, began.0),
        }
    }

    /// Follows a lane along a wall that chance presses it to, for as long as that push lasts.
    #[inline(never)]
    pub(super) fn follow_pressed<const W: usize>(
        &self,
        crew: &mut Crew<W, D::Many<W>>,
        l: usize,
        hit: &Hit,
        after: &After,
        sink: &mut dyn Sink,
    ) {
        let (began, until) = (crew.time[l], crew.stop[l]);
        let mut body = crew.bodies.one(l);
        if self.drifts() && !self.leans() {
            body.eddy = [Some(crew.lanes[l].chance.midway(until - began))];
        }
        let mut contact = self.contact(crew, l, hit, after).pressed_by_chance(&body, until);
        let (number, traced) = (crew.lanes[l].particle.number, crew.lanes[l].trace);
        for _ in 0..WEDGED {
            let ending = contact.run(|time, m| {
                if traced {
                    sink.point(number, time, m.x, m.v, m.spin);
                }
            });
            self.bring(crew, l, &contact, sink);
            match ending {
                Ending::Stalls => {
                    sink.stalled();
                    return finish(crew, l, ParticleFate::Airborne, None, sink);
                }
                Ending::Lost(cell) => return lose(crew, l, cell, sink),
                // held in a corner: it stays there as long as it is pushed
                Ending::Rests => {
                    crew.time[l] = until;
                    put(crew, l, contact.place(), hit.wall_velocity, [0.0; 3]);
                    break;
                }
                Ending::TimeIsUp | Ending::Leaves(_) => break,
                Ending::Meets(other) => {
                    let (before, struck, stays) = self.strike(crew, l, &mut contact, &other);
                    self.struck(crew, l, &other, &before, &struck, sink);
                    if let Some(fate) = struck.event.ends() {
                        return finish(crew, l, fate, Some(other.wall), sink);
                    }
                    if !stays {
                        break;
                    }
                }
            }
        }
        if crew.time[l] >= self.settings.until {
            return finish(crew, l, ParticleFate::Airborne, None, sink);
        }
        self.fly_on(crew, l, began);
    }

    /// An impact on another wall during contact motion: the motion before it, what it leaves, and whether the motion along the first wall
    /// goes on.
    fn strike<const W: usize>(
        &self,
        crew: &mut Crew<W, D::Many<W>>,
        l: usize,
        contact: &mut Contact<'_, D>,
        hit: &Hit,
    ) -> (Motion, After, bool) {
        let before = contact.motion;
        crew.lanes[l].impacts += 1;
        let mut after = self.outcome(crew, l, hit, before.v, before.spin);
        let is_held = matches!(after.event, Event::Capture | Event::Settle);
        if is_held && let Some(mode) = self.removes(crew, l, hit) {
            after.event = Event::Remove(mode);
        }
        let stays = contact.goes_on(Motion { v: after.velocity, spin: after.spin, ..before });
        (before, after, stays)
    }

    /// Gives a lane what such an impact left, and the impact its row.
    fn struck<const W: usize>(
        &self,
        crew: &mut Crew<W, D::Many<W>>,
        l: usize,
        hit: &Hit,
        before: &Motion,
        after: &After,
        sink: &mut dyn Sink,
    ) {
        put(crew, l, before.x, after.velocity, after.spin);
        sink.impact(&record(&crew.lanes[l], crew.time[l], hit, before.v, before.spin, after));
    }

    /// Brings a lane up to its contact motion.
    fn bring<const W: usize>(
        &self,
        crew: &mut Crew<W, D::Many<W>>,
        l: usize,
        contact: &Contact<'_, D>,
        sink: &mut dyn Sink,
    ) {
        if contact.strayed && !crew.lanes[l].strayed {
            crew.lanes[l].strayed = true;
            sink.strayed();
        }
        crew.here.set(l, contact.here);
        (crew.time[l], crew.steps[l]) = (contact.time, contact.steps);
        put(crew, l, contact.motion.x, contact.motion.v, contact.motion.spin);
    }

    /// A lane flies again.
    fn fly_on<const W: usize>(&self, crew: &mut Crew<W, D::Many<W>>, l: usize, since: f64) {
        if crew.time[l] > since {
            crew.lanes[l].standing = 0;
        }
        crew.next[l] = self.first_step(crew, l);
        if self.has_chance() {
            self.renew(crew, l, crew.time[l] - since);
        }
    }

    /// The row where contact motion ends: speeds along the wall where it began and where it ends, and as shares of the energy there
    /// was, the motion's and what the forces did, what friction took and what is left.
    fn end_row<const W: usize>(
        &self,
        crew: &Crew<W, D::Many<W>>,
        l: usize,
        contact: &Contact<'_, D>,
        (began, ended): (Motion, Motion),
        event: Event,
        sink: &mut dyn Sink,
    ) {
        let lane: &Lane = &crew.lanes[l];
        let wall_velocity = self.domain.walls().list().get(contact.wall).map_or([0.0; 3], |w| w.velocity);
        let m = ended;
        let (velocity, spin) = if event == Event::Settle { (wall_velocity, [0.0; 3]) } else { (m.v, m.spin) };
        let radius = crew.bodies.radius[l];
        let left = 0.5 * square(sub(m.v, wall_velocity)) + 0.2 * radius * radius * square(m.spin);
        let all = left + contact.worn;
        let share = |e: f64| if all > 0.0 { e / all } else { 0.0 };
        let energy = Energy::without_mechanism(0.0, share(contact.worn), share(left));
        let meeting = Meeting { theta: 0.0, position: contact.place(), normal: contact.normal };
        let hit = Hit { wall: contact.wall, face: None, meeting, wall_velocity };
        let after = After {
            event,
            velocity,
            spin,
            restitution: f64::NAN,
            impulse_ratio: f64::NAN,
            energy,
            validity: Validity::NONE,
            bounces: false,
        };
        let along = |v: Vec3| {
            // the row is of the motion along the wall: rounding across it is none
            let across = dot(sub(v, wall_velocity), contact.normal);
            [0, 1, 2].map(|c| v[c] - across * contact.normal[c])
        };
        debug_assert!(norm(contact.normal) > 0.5);
        sink.contact_ended(&record(lane, contact.time, &hit, along(began.v), began.spin, &after));
    }
}

fn square(v: Vec3) -> f64 {
    dot(v, v)
}
