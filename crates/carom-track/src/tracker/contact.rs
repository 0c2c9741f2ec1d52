//! Contact motion: a sphere whose bounces have died down slides or rolls on along its wall.
//!
//! It is held to the wall as long as the steady forces press (weight, mean drag, lift, less what the wall's curvature asks; kicks and
//! eddies neither press nor hold), slowed by the law's friction until it rolls, rolls on where nothing slows it, and leaves where
//! nothing presses or the wall ends. It has settled when this motion has ended too. Between two walls it moves along their groove,
//! and three hold it.
//!
//! An eddy that pushes a sphere against a wall it bounces off makes a series of ever lower bounces too. Below the height that
//! counts as none they are this motion for as long as that push lasts: the same force along the wall, the same friction, but it never
//! settles and no row tells of it.
//!
//! With p the force per mass that presses, v_s the slip of the contact point and f the friction coefficient: sliding, v' = a − f p v̂_s
//! and ω' = (5/2)(f p/R)(n × v̂_s); rolling, the friction −(2/7) v_s' that keeps the slip zero, as long as f p is enough for it.

mod adhered;
mod friction;
mod stop;
mod surface;

use super::Walk;
use super::cross::{NO_WAY, ROUND};
use super::meeting::LOWEST;
use super::rounding::{GOOD, Tried};
use super::walk::least_step;
use crate::domain::{Domain, Hit, Next};
use crate::dynamics::Bodies;
use crate::flow::cells::carry_spin;
use crate::geometry::{Path, Shape, evaluate};
use crate::integrate::{Control, Derivative, Motion as Motions, Rates, Step, exponential, growth, step};
use crate::record::Event;
use crate::vector::{Vec3, add, dot, norm, scale, sub};
pub(super) use adhered::Adhered;
use friction::{Kind, OnSurface};
use stop::Stop;
use surface::{Held, Rub, Surface};

/// Position, velocity and spin of a sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Motion {
    pub x: Vec3,
    pub v: Vec3,
    pub spin: Vec3,
}

/// What a sphere in contact comes to.
#[derive(Clone, Copy, Debug)]
pub(super) enum Ending {
    /// Rest.
    Rests,
    /// The end of the run.
    TimeIsUp,
    /// It leaves the wall.
    Leaves(Event),
    /// Another wall, met with the motion it has.
    Meets(Hit),
    /// Its steps ran out.
    Stalls,
    /// It is outside the space. It was last in that cell.
    Lost(Option<u32>),
}

/// Force along the surface over the one across it that counts as none.
const LEVEL: f64 = 1e-9;
/// Share of the radius by which a path is lifted off its own wall before others are looked for.
const LIFT: f64 = 1e-10;
/// And of the coordinates: more than their rounding.
const ROUNDED: f64 = 8e-15;
/// Heights that count as none by which closed gaps may move a sphere.
const MOST_CLOSED: f64 = 10.0;
/// Radii that a step may go along triangles: their edges are looked for four times a step.
const STRIDE: f64 = 4.0;
/// A step of a motion without end is long enough to call it that, s.
const ENDLESS: f64 = 1e12;

/// A sphere in contact motion.
pub(super) struct Contact<'a, D: Domain> {
    walk: Walk<'a, D>,
    body: Bodies<1>,
    injection: usize,
    /// A height that counts as none, m.
    height: f64,
    pub here: D::Here,
    pub time: f64,
    pub motion: Motion,
    /// Trial steps so far.
    pub steps: u64,
    /// Energy per mass that friction took, m²/s².
    pub worn: f64,
    /// The wall it is on, and its normal there.
    pub wall: usize,
    pub normal: Vec3,
    /// Whether it has been where nothing is known of the fluid.
    pub strayed: bool,
    rolls: bool,
    /// Whether it steps as a sphere that follows the fluid.
    follows: bool,
    next: f64,
    /// Edges in a row without getting on.
    edges: u32,
    /// By how much a path is lifted off what the sphere touches, before other walls are looked for, m.
    lift: Vec3,
    /// Its end at the latest, s.
    until: f64,
    /// Whether chance presses it too, for that long.
    chance_presses: bool,
    /// What holds it by adhesion, if it rolls against that.
    adhered: Option<Adhered>,
    /// Which way adhesion resists, against it.
    heading: Vec3,
}

impl<'a, D: Domain> Contact<'a, D> {
    /// A sphere that just lost its motion across a wall.
    #[allow(clippy::too_many_arguments)]
    pub fn new(
        walk: Walk<'a, D>,
        mut body: Bodies<1>,
        injection: usize,
        (here, time): (D::Here, f64),
        motion: Motion,
        wall: usize,
        normal: Vec3,
        steps: u64,
    ) -> Self {
        body.eddy = [None];
        let radius = body.radius[0];
        let height = walk.settings.settle_height.of(radius).max(LOWEST * radius);
        let next = 1e-3;
        let (worn, rolls, lift) = (0.0, false, [0.0; 3]);
        let (until, chance_presses) = (walk.settings.until, false);
        let follows = walk.dynamics.follows(&body.sphere[0]);
        Self {
            walk,
            body,
            injection,
            height,
            here,
            time,
            motion,
            steps,
            worn,
            wall,
            normal,
            strayed: false,
            rolls,
            follows,
            next,
            edges: 0,
            lift,
            until,
            chance_presses,
            adhered: None,
            heading: [0.0; 3],
        }
    }

    /// With chance pressing it as `body` says, until a time.
    pub fn pressed_by_chance(mut self, body: &Bodies<1>, until: f64) -> Self {
        self.body.eddy = body.eddy;
        (self.until, self.chance_presses) = (until, true);
        self
    }

    fn radius(&self) -> f64 {
        self.body.radius[0]
    }

    /// The pressing forces' acceleration and angular acceleration: the steady ones', and chance's where it presses.
    fn steady(&self, time: f64, m: &Motion) -> (Vec3, Vec3) {
        self.shared(&self.rates(time, m))
    }

    fn rates(&self, time: f64, m: &Motion) -> Rates<1> {
        match self.adhered() {
            Some(held) => self.rates_as_adhered(held, time, m),
            None => self.walk.rates_at((self.here, time), &self.body, m.x, m.v, m.spin),
        }
    }

    /// Acceleration and angular acceleration of some rates.
    fn shared(&self, r: &Rates<1>) -> (Vec3, Vec3) {
        let column = |v: &[[f64; 1]; 3]| [v[0][0], v[1][0], v[2][0]];
        let spins = self.walk.dynamics.spins() || self.adhered().is_some();
        (column(&r.a), if spins { column(&r.alpha) } else { [0.0; 3] })
    }

    /// The walls that closed gaps might move the sphere into.
    fn near(&self) -> Vec<Held<'a>> {
        let walls = self.walk.domain.walls();
        let supports = walls.support(self.motion.x, self.radius(), (1.0 + MOST_CLOSED) * self.height);
        let held = supports.iter().filter_map(|s| {
            let wall = walls.list().get(s.wall)?;
            let speed = norm(sub(self.motion.v, wall.velocity));
            let rub = Rub::of(self.walk.behaviors.get(s.wall), self.injection, speed);
            Some(Held { index: s.wall, wall, normal: s.normal, rub, gap: s.gap })
        });
        held.collect()
    }

    /// Whether a wall is within the height that counts as none, and the sphere moves off from it, or into it, by no more than such a bounce.
    fn touches(&self, c: &Held, a: Vec3) -> bool {
        if c.gap > self.height {
            return false;
        }
        let v = sub(self.motion.v, c.wall.velocity);
        let across = dot(v, c.normal);
        across.abs() <= 1e-9 * norm(v) || across * across <= 2.0 * self.height * norm(a)
    }

    /// The surface the sphere moves on, with its velocity along it; `Err` with what it comes to instead.
    fn surface(&mut self) -> Result<Surface<'a>, Ending> {
        let (a, _) = self.steady(self.time, &self.motion);
        let near = self.near();
        let contacts: Vec<_> = near.iter().filter(|c| self.touches(c, a)).copied().collect();
        if contacts.is_empty() {
            return Err(Ending::Leaves(self.off()));
        }
        let Some(surface) = Surface::choose(&contacts, &self.motion, a) else {
            return Err(Ending::Rests);
        };
        let Some(first) = surface.list().first() else { return Err(Ending::Leaves(Event::LiftOff)) };
        (self.wall, self.normal) = (first.index, first.normal);
        let u = surface.wall_velocity();
        let far = self.motion.x.iter().fold(0.0f64, |m, c| m.max(c.abs()));
        let reach = (LIFT * self.radius()).max(ROUNDED * far);
        self.lift = contacts.iter().fold([0.0; 3], |l, c| add(l, scale(c.normal, reach)));
        self.motion.x = add(self.motion.x, surface.closing(&near, MOST_CLOSED * self.height));
        self.motion.v = add(u, surface.along(sub(self.motion.v, u)));
        let ended = surface.list().iter().any(|c| c.rub == Rub::Ended);
        self.heading = self.heading(&surface);
        if ended || (!self.chance_presses && self.is_at_rest(&surface)) { Err(Ending::Rests) } else { Ok(surface) }
    }

    /// Whether it stays where it is from the beginning; what it comes to else, if it does not move along a wall at all.
    pub fn begin(&mut self) -> Option<Ending> {
        self.surface().err()
    }

    /// Where the sphere is, exactly in contact with its wall.
    pub fn place(&self) -> Vec3 {
        let mut x = self.motion.x;
        let Some(wall) = self.walk.domain.walls().list().get(self.wall) else { return x };
        // over an edge where the wall just ended it is that height off, and not straight along the normal
        for _ in 0..4 {
            let gap = wall.shape.distance(x) - wall.clearance(self.radius());
            if gap.abs() <= (1.0 + 1e-6) * self.height {
                x = sub(x, scale(self.normal, gap));
            }
        }
        x
    }

    /// The word for leaving by an impact on another wall.
    pub fn left_by(&self) -> Event {
        self.off()
    }

    /// The word for leaving by its own motion.
    fn off(&self) -> Event {
        if self.rolls { Event::RollOff } else { Event::SlideOff }
    }

    /// Whether the motion along the surface has ended: the rest of its way, or the height it swings to, counts as none, and nothing
    /// drives it where it is.
    fn is_at_rest(&self, surface: &Surface) -> bool {
        if self.adhered().is_some() {
            return self.heading == [0.0; 3] || self.creeps(surface);
        }
        let m = &self.motion;
        let u = surface.wall_velocity();
        let v = sub(m.v, u);
        let still = Motion { v: u, spin: [0.0; 3], ..*m };
        let (a, _) = self.steady(self.time, &still);
        let pressed = surface.press(&still, a);
        let driven = surface.along(pressed.acceleration);
        let (now, turn) = self.steady(self.time, m);
        let kind = self.kind(surface);
        let slowed = surface.along(self.accelerations(surface, kind, m, now, turn).0);
        let ends = |v: Vec3, driven: Vec3, slowed: Vec3| {
            let speed = norm(v);
            let level = norm(driven) <= LEVEL * pressed.total;
            level && (speed == 0.0 || speed * speed * speed < self.height * -dot(slowed, v))
        };
        let Some(circle) = surface.hollow(self.radius()) else { return ends(v, driven, slowed) };
        // a pendulum around, and as on a plane along
        let Some(Shape::Cylinder(c)) = surface.list().first().map(|c| &c.wall.shape) else { return false };
        let axial = |v: Vec3| scale(c.axis, dot(v, c.axis));
        let (around, pull) = (sub(v, axial(v)), sub(driven, axial(driven)));
        let swing = 0.5 * dot(around, around) + 0.5 * dot(pull, pull) * circle / pressed.total;
        swing < self.height * pressed.total && ends(axial(v), axial(driven), axial(slowed))
    }

    /// Follows the motion until it comes to something.
    pub fn run(&mut self, mut trace: impl FnMut(f64, &Motion)) -> Ending {
        loop {
            let surface = match self.surface() {
                Ok(surface) => surface,
                Err(ending) => return ending,
            };
            let kind = self.kind(&surface);
            self.rolls = matches!(kind, Kind::Rolls);
            let until = self.until;
            let h = self.length(&surface).min(until - self.time);
            if h <= 0.0 || h > ENDLESS {
                return Ending::TimeIsUp;
            }
            trace(self.time, &self.motion);
            self.steps += 1;
            let trial = self.attempt(&surface, kind, h);
            let factor = growth(trial.error_squared[0], true);
            if self.steps > self.walk.settings.max_steps || self.time + h == self.time {
                return Ending::Stalls;
            }
            let good = trial.error_squared[0] <= 1.0;
            if !good {
                self.next = h * factor.min(0.9);
                continue;
            }
            let path = self.path(&trial);
            if let Next::Longest(share) = self.walk.domain.edge(self.here, &path) {
                self.next = h * share;
                continue;
            }
            let (before, left) = (self.time, self.here);
            let (theta, stop) = self.first_stop(&surface, kind, &trial, &path, h);
            self.worn += self.work(&surface, kind, &trial, h, theta);
            self.take(&surface, &trial, h, theta, until);
            if h >= self.next || factor < 1.0 {
                self.next = h * factor;
            }
            match stop {
                Stop::Whole => {}
                Stop::Edge(into) => {
                    self.edges = if self.time > before && theta >= NO_WAY { 0 } else { self.edges + 1 };
                    // led round and round where pieces overlap
                    let round = self.edges > ROUND;
                    self.here =
                        if round { self.walk.domain.enter_ahead(into, self.motion.x, self.motion.v) } else { into };
                    self.strayed |= self.walk.domain.is_beyond(into);
                }
                Stop::Carried(into, carry) => {
                    self.here = into;
                    let Motion { x, v, spin } = self.motion;
                    self.motion = Motion { x: carry.point(x), v: carry.vector(v), spin: carry_spin(&carry, spin) };
                }
                Stop::Wall(hit) => return Ending::Meets(self.touch(hit)),
                Stop::Grip => self.rolls = !self.rolls,
                Stop::Still => (self.motion.v, self.motion.spin) = (surface.wall_velocity(), [0.0; 3]),
                Stop::Press if surface.list().len() == 1 => return Ending::Leaves(self.lost(&surface)),
                Stop::Press => {}
                Stop::Support => return Ending::Leaves(self.off()),
            }
            if self.walk.domain.is_lost(self.here) {
                self.here = self.walk.domain.enter(self.time, self.motion.x);
                if self.walk.domain.is_lost(self.here) {
                    return Ending::Lost(self.walk.domain.cell(left));
                }
            }
        }
    }

    /// The word for leaving where the force presses no more: thrown off a round wall, lifted off a flat one.
    fn lost(&self, surface: &Surface) -> Event {
        let round = surface.list().iter().any(|c| matches!(c.wall.shape, Shape::Cylinder(_)));
        if round { self.off() } else { Event::LiftOff }
    }

    fn length(&self, surface: &Surface) -> f64 {
        let speed = norm(sub(self.motion.v, surface.wall_velocity()));
        let longest = self.walk.domain.longest(self.here, self.motion.x, self.motion.v);
        let meshed = surface.list().iter().any(|c| matches!(c.wall.shape, Shape::Mesh(_)));
        let stride = if meshed { STRIDE * self.radius() / speed } else { f64::INFINITY };
        self.next.min(longest).min(stride).max(least_step(self.time))
    }

    fn attempt(&self, surface: &Surface, kind: Kind, h: f64) -> Step<1> {
        let column = |v: Vec3| v.map(|c| [c]);
        let m = &self.motion;
        let start = Motions { x: column(m.x), v: column(m.v), spin: column(m.spin) };
        let acting = OnSurface { contact: self, surface, kind };
        let mut first = Rates::ZERO;
        acting.rates(&[self.time], &start, &mut first);
        // the spin of a sphere that rolls and follows the fluid is known from its speed
        let spins = !(self.follows && matches!(kind, Kind::Rolls));
        let control = Control { tolerance: self.walk.per_step(), spins, place: true };
        let mut out = Step::ZERO;
        if self.follows {
            exponential::step(&[self.time], &start, &first, &[h], control, &acting, &mut out);
        } else {
            step(&[self.time], &start, &first, &[h], control, &acting, &mut out);
        }
        let velocities = [m.v, out.end.v.map(|c| c[0]), first.a.map(|c| h * c[0])];
        let tried = Tried { from: m.x, h, error_squared: out.error_squared[0], velocities, drag_rate: first.drag[0] };
        if tried.error_squared > 1.0 && tried.is_rounding(control.tolerance) {
            out.error_squared = [GOOD];
        }
        out
    }

    fn path(&self, trial: &Step<1>) -> Path {
        Path { start: self.motion.x, points: trial.path.map(|p| [p[0][0], p[1][0], p[2][0]]) }
    }

    /// The motion at θ of a step.
    fn at(&self, trial: &Step<1>, h: f64, theta: f64) -> Motion {
        let (offset, v) = trial.along(&[h], &[theta]);
        let column = |v: [[f64; 1]; 3]| [v[0][0], v[1][0], v[2][0]];
        let twist = trial.twist.map(column);
        Motion {
            x: add(self.motion.x, column(offset)),
            v: column(v),
            spin: add(self.motion.spin, evaluate(&twist, theta)),
        }
    }

    /// Puts the sphere exactly in contact with a wall it meets.
    fn touch(&mut self, mut hit: Hit) -> Hit {
        if let Some(wall) = self.walk.domain.walls().list().get(hit.wall) {
            let gap = wall.shape.distance(self.motion.x) - wall.clearance(self.radius());
            self.motion.x = sub(self.motion.x, scale(hit.meeting.normal, gap));
        }
        hit.meeting.position = self.motion.x;
        hit
    }

    /// Takes a step up to θ.
    fn take(&mut self, surface: &Surface, trial: &Step<1>, h: f64, theta: f64, until: f64) {
        self.motion = self.at(trial, h, theta);
        self.time = if theta == 1.0 && h >= until - self.time { until } else { self.time + theta * h };
        let here = surface.at(self.motion.x);
        let radius = self.radius();
        if let [c] = here.list()
            && let Shape::Cylinder(round) = &c.wall.shape
        {
            let off = round.distance(self.motion.x) - c.wall.clearance(radius);
            self.motion.x = sub(self.motion.x, scale(c.normal, off));
        }
        let u = here.wall_velocity();
        self.motion.v = add(u, here.along(sub(self.motion.v, u)));
        if self.rolls {
            self.motion.spin = here.rolling_spin(&self.motion, radius);
        }
    }

    /// Goes on after an impact on another wall: whether the sphere still moves along the wall it was on.
    pub fn goes_on(&mut self, motion: Motion) -> bool {
        let wall = self.walk.domain.walls().list().get(self.wall).map_or([0.0; 3], |w| w.velocity);
        let v = sub(motion.v, wall);
        let stays = dot(v, self.normal).abs() <= 1e-9 * norm(v);
        self.motion = motion;
        self.rolls = false;
        stays
    }
}
