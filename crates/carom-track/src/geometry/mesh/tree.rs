//! A hierarchy of boxes around triangles: four children to a node, their boxes side by side.
//!
//! Built top down by the surface-area heuristic over bins (Wald 2007, doi:10.1109/RT.2007.4342588), halves in parallel; the
//! result does not depend on the number of threads. Our own rather than a kept crate: the boxes are in double precision, so
//! that nothing is lost far from the origin, and the search follows a curve of finite width, not a ray.

use super::super::Bounds;
use crate::vector::{Vec3, norm, sub};

/// Four boxes and what is in them.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub(crate) struct Node {
    /// Lower and upper sides of the four boxes, axis by axis; an absent child's box is empty.
    pub min: [[f64; 4]; 3],
    pub max: [[f64; 4]; 3],
    pub children: [Child; 4],
}

/// A node or a run of triangles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Child {
    /// Index of the node, or of the first triangle.
    pub first: u32,
    /// Number of triangles; 0 for a node.
    pub count: u32,
    /// The plane that all triangles in it lie in, none of which has an edge or a corner to look after; [`MIXED`] if there is no
    /// such plane.
    pub flat: u32,
}

/// More than one plane.
pub(crate) const MIXED: u32 = u32::MAX;

/// The hierarchy; the first node is the root.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Tree {
    pub nodes: Vec<Node>,
}

/// Most triangles in a leaf.
const LEAF: usize = 4;
/// Bins along each axis.
const BINS: usize = 16;
/// Depth below which runs are halved by number, so that the search's stack has a bound.
const DEEP: u32 = 40;
/// Runs longer than this are split in parallel.
const PARALLEL: usize = 4096;

/// Most nodes that wait while the search goes down: three of each level, `DEEP` levels and those of 2³² triangles halved.
pub(crate) const STACK: usize = 3 * (DEEP as usize + 32) + 4;

/// A triangle's box in single precision, rounded outwards: enough to choose splits by.
#[derive(Clone, Copy)]
struct Item {
    min: [f32; 3],
    max: [f32; 3],
    index: u32,
}

/// How boxes are put into two parts.
#[derive(Clone, Copy)]
pub(crate) enum Halves {
    /// So that few have to be looked into: for what is asked at every step.
    LeastArea,
    /// In the middle of the longest side: made in a fifth of the time, for what is asked seldom.
    Middle,
}

enum Branch {
    Leaf(Bounds, Child),
    Fork(Bounds, Box<[Branch; 2]>),
}

impl Branch {
    fn bounds(&self) -> &Bounds {
        match self {
            Self::Leaf(b, _) | Self::Fork(b, _) => b,
        }
    }
}

impl Node {
    const EMPTY: Self = Self {
        min: [[f64::INFINITY; 4]; 3],
        max: [[f64::NEG_INFINITY; 4]; 3],
        children: [Child { first: 0, count: 0, flat: MIXED }; 4],
    };

    /// The box of a child.
    pub fn bounds(&self, child: usize) -> Bounds {
        Bounds { min: [0, 1, 2].map(|c| self.min[c][child]), max: [0, 1, 2].map(|c| self.max[c][child]) }
    }

    /// Its children, but for absent ones.
    pub fn children(&self) -> impl Iterator<Item = (Bounds, Child)> {
        (0..4).map(|i| (self.bounds(i), self.children[i])).filter(|(b, _)| b.min[0] <= b.max[0])
    }
}

impl Tree {
    /// Over boxes; the order in which the leaves name them.
    pub fn new(boxes: &[Bounds], halves: Halves) -> (Self, Vec<u32>) {
        let mut items: Vec<Item> = boxes
            .iter()
            .zip(0..)
            .map(|(b, index)| Item {
                min: b.min.map(|c| (c as f32).next_down()),
                max: b.max.map(|c| (c as f32).next_up()),
                index,
            })
            .collect();
        let mut tree = Self::default();
        if !items.is_empty() {
            let root = grow(&mut items, 0, boxes, (halves, 0));
            tree.flatten(&root);
        }
        (tree, items.iter().map(|i| i.index).collect())
    }

    /// The box around all.
    pub fn bounds(&self) -> Bounds {
        self.nodes.first().map_or(Bounds::NONE, |n| n.children().fold(Bounds::NONE, |all, (b, _)| all.union(&b)))
    }

    /// Tells each child its plane, given each triangle's ([`MIXED`] for one with edges or corners).
    pub fn name_flats(&mut self, flats: &[u32]) {
        // nodes come after their parents
        for i in (0..self.nodes.len()).rev() {
            for child in 0..4 {
                let Child { first, count, .. } = self.nodes[i].children[child];
                let flat = if count > 0 {
                    common(flats[first as usize..(first + count) as usize].iter().copied())
                } else if first as usize > i {
                    common(self.nodes[first as usize].children().map(|(_, c)| c.flat))
                } else {
                    MIXED
                };
                self.nodes[i].children[child].flat = flat;
            }
        }
    }

    /// Half the diagonal of a leaf's box, as a mean, m.
    pub fn leaf_size(&self) -> f64 {
        let leaves = self.nodes.iter().flat_map(Node::children).filter(|(_, c)| c.count > 0);
        let (sum, count) =
            leaves.fold((0.0, 0.0f64), |(sum, n), (b, _)| (sum + 0.5 * norm(sub(b.max, b.min)), n + 1.0));
        sum / count.max(1.0)
    }

    /// Four children to a node: forks open, the largest first.
    fn flatten(&mut self, branch: &Branch) -> u32 {
        let here = self.nodes.len();
        self.nodes.push(Node::EMPTY);
        let mut open: Vec<&Branch> = vec![branch];
        while open.len() < 4 {
            let forks = open.iter().enumerate().filter(|(_, b)| matches!(b, Branch::Fork(..)));
            let largest = forks.max_by(|a, b| area(a.1.bounds()).total_cmp(&area(b.1.bounds()))).map(|(i, _)| i);
            let Some(Branch::Fork(_, halves)) = largest.map(|i| open.swap_remove(i)) else { break };
            open.extend(halves.iter());
        }
        for (i, branch) in open.into_iter().enumerate() {
            let bounds = *branch.bounds();
            let child = match branch {
                Branch::Leaf(_, child) => *child,
                Branch::Fork(..) => Child { first: self.flatten(branch), count: 0, flat: MIXED },
            };
            let node = &mut self.nodes[here];
            for c in 0..3 {
                (node.min[c][i], node.max[c][i]) = (bounds.min[c], bounds.max[c]);
            }
            node.children[i] = child;
        }
        here as u32
    }
}

/// What all are, or [`MIXED`].
fn common(mut flats: impl Iterator<Item = u32>) -> u32 {
    let first = flats.next().unwrap_or(MIXED);
    if flats.all(|f| f == first) { first } else { MIXED }
}

fn area(b: &Bounds) -> f64 {
    let s: Vec3 = [0, 1, 2].map(|c| b.max[c] - b.min[c]);
    s[0] * s[1] + s[1] * s[2] + s[2] * s[0]
}

fn grow(items: &mut [Item], first: u32, boxes: &[Bounds], (how, depth): (Halves, u32)) -> Branch {
    let count = items.len();
    let middle = match how {
        _ if depth >= DEEP => (count > LEAF).then_some(count / 2),
        Halves::LeastArea => split(items),
        Halves::Middle => (count > LEAF).then(|| halve(items)),
    };
    let Some(middle) = middle else {
        let bounds = items.iter().fold(Bounds::NONE, |all, i| all.union(&boxes[i.index as usize]));
        return Branch::Leaf(bounds, Child { first, count: count as u32, flat: MIXED });
    };
    let (low, high) = items.split_at_mut(middle);
    let second = first + middle as u32;
    let next = (how, depth + 1);
    let halves = if count > PARALLEL {
        rayon::join(|| grow(low, first, boxes, next), || grow(high, second, boxes, next))
    } else {
        (grow(low, first, boxes, next), grow(high, second, boxes, next))
    };
    Branch::Fork(halves.0.bounds().union(halves.1.bounds()), Box::new([halves.0, halves.1]))
}

#[derive(Clone, Copy)]
struct Bin {
    min: [f32; 3],
    max: [f32; 3],
    count: usize,
}

impl Bin {
    const EMPTY: Self = Self { min: [f32::INFINITY; 3], max: [f32::NEG_INFINITY; 3], count: 0 };

    #[inline(always)]
    fn add(&mut self, min: &[f32; 3], max: &[f32; 3], count: usize) {
        for c in 0..3 {
            self.min[c] = self.min[c].min(min[c]);
            self.max[c] = self.max[c].max(max[c]);
        }
        self.count += count;
    }

    /// Half the area of the box, times what is in it.
    fn cost(&self) -> f32 {
        if self.count == 0 {
            return 0.0;
        }
        let s = [0, 1, 2].map(|c| self.max[c] - self.min[c]);
        (s[0] * s[1] + s[1] * s[2] + s[2] * s[0]) * self.count as f32
    }
}

/// Puts items on both sides of the middle of their centres and says where the second part begins.
fn halve(items: &mut [Item]) -> usize {
    let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    for item in items.iter() {
        for c in 0..3 {
            // twice the centre
            let center = item.min[c] + item.max[c];
            (low[c], high[c]) = (low[c].min(center), high[c].max(center));
        }
    }
    let wide = |c: usize| high[c] - low[c];
    let c = (1..3).fold(0, |widest, c| if wide(c) > wide(widest) { c } else { widest });
    let middle = low[c] + 0.5 * wide(c);
    let first = partition(items, |i| i.min[c] + i.max[c] < middle);
    if first == 0 || first == items.len() { items.len() / 2 } else { first }
}

/// Puts items into two parts and says where the second begins; none where they are better left together.
fn split(items: &mut [Item]) -> Option<usize> {
    let count = items.len();
    if count <= 1 {
        return None;
    }
    // twice the centres
    let (mut low, mut high, mut whole) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3], Bin::EMPTY);
    for item in items.iter() {
        for c in 0..3 {
            let center = item.min[c] + item.max[c];
            (low[c], high[c]) = (low[c].min(center), high[c].max(center));
        }
        whole.add(&item.min, &item.max, 1);
    }
    let scale = [0, 1, 2].map(|c| BINS as f32 * (1.0 - 1e-5) / (high[c] - low[c]));
    let bin = |item: &Item, c: usize| ((item.min[c] + item.max[c] - low[c]) * scale[c]) as usize;
    let mut best: Option<(f32, usize, usize)> = None;
    for c in (0..3).filter(|c| scale[*c].is_finite()) {
        let mut bins = [Bin::EMPTY; BINS];
        for item in items.iter() {
            bins[bin(item, c).min(BINS - 1)].add(&item.min, &item.max, 1);
        }
        let mut above = [0.0; BINS];
        let mut all = Bin::EMPTY;
        for i in (1..BINS).rev() {
            all.add(&bins[i].min, &bins[i].max, bins[i].count);
            above[i] = all.cost();
        }
        all = Bin::EMPTY;
        for i in 1..BINS {
            all.add(&bins[i - 1].min, &bins[i - 1].max, bins[i - 1].count);
            let cost = all.cost() + above[i];
            if all.count > 0 && all.count < count && best.is_none_or(|b| cost < b.0) {
                best = Some((cost, c, i));
            }
        }
    }
    match best {
        // a look into one box more costs about as much as one triangle
        Some((cost, ..)) if count <= LEAF && cost + whole.cost() / count as f32 >= whole.cost() => None,
        Some((_, c, edge)) => Some(partition(items, |i| bin(i, c).min(BINS - 1) < edge)),
        None if count <= LEAF => None,
        None => Some(count / 2),
    }
}

/// Those that something is true of first; how many they are.
fn partition(items: &mut [Item], is_first: impl Fn(&Item) -> bool) -> usize {
    let mut firsts = 0;
    for i in 0..items.len() {
        if is_first(&items[i]) {
            items.swap(i, firsts);
            firsts += 1;
        }
    }
    firsts
}
