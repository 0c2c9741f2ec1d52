//! A case written with whole numbers and numbers of any size, as no program here does.

use carom_cfd::Mesh;

use super::*;

struct Sizes {
    label: usize,
    scalar: usize,
}

impl Sizes {
    fn header(&self, class: &str) -> Vec<u8> {
        let (label, scalar) = (8 * self.label, 8 * self.scalar);
        format!("FoamFile\n{{\n version 2;\n format binary;\n class {class};\n arch \"LSB;label={label};scalar={scalar}\";\n}}\n")
            .into_bytes()
    }

    fn labels(&self, out: &mut Vec<u8>, list: impl ExactSizeIterator<Item = u32>) {
        out.extend(format!("\n{}\n(", list.len()).bytes());
        list.for_each(|l| out.extend(&u64::from(l).to_le_bytes()[..self.label]));
        out.extend(b")\n");
    }

    fn reals<const N: usize>(&self, out: &mut Vec<u8>, list: &[[f64; N]]) {
        out.extend(format!("\n{}\n(", list.len()).bytes());
        for x in list.iter().flatten() {
            match self.scalar {
                4 => out.extend((*x as f32).to_le_bytes()),
                _ => out.extend(x.to_le_bytes()),
            }
        }
        out.extend(b")\n");
    }

    fn mesh(&self, mesh: &Mesh, boundary: &Path, compact: bool, folder: &Path) {
        fs::create_dir_all(folder).unwrap();
        let write = |name: &str, class: &str, fill: &dyn Fn(&mut Vec<u8>)| {
            let mut bytes = self.header(class);
            fill(&mut bytes);
            fs::write(folder.join(name), bytes).unwrap();
        };
        write("points", "vectorField", &|out| self.reals(out, &mesh.points));
        write("owner", "labelList", &|out| self.labels(out, mesh.owner.iter().copied()));
        write("neighbour", "labelList", &|out| self.labels(out, mesh.neighbour.iter().copied()));
        write("faces", if compact { "faceCompactList" } else { "faceList" }, &|out| {
            if compact {
                self.labels(out, mesh.faces.starts.iter().copied());
                return self.labels(out, mesh.faces.corners.iter().copied());
            }
            out.extend(format!("\n{}\n(", mesh.faces.len()).bytes());
            (0..mesh.faces.len()).for_each(|f| self.labels(out, mesh.faces.get(f).iter().copied()));
            out.extend(b")\n");
        });
        fs::copy(boundary, folder.join("boundary")).unwrap();
    }
}

#[test]
fn labels_and_scalars_of_every_size() {
    let known = latest(&stored("block"));
    for (label, scalar, compact) in [(4, 4, true), (4, 8, false), (8, 4, false), (8, 8, true)] {
        let sizes = Sizes { label, scalar };
        let folder = tempfile::tempdir().unwrap();
        let boundary = stored("block").join("constant/polyMesh/boundary");
        sizes.mesh(&known.mesh, &boundary, compact, &folder.path().join("constant/polyMesh"));
        fs::create_dir(folder.path().join("2")).unwrap();
        let (cells, _) = values(known.fields.velocity.as_ref());
        let mut field = sizes.header("volVectorField");
        field.extend(b"dimensions [0 1 -1 0 0 0 0];\ninternalField nonuniform List<vector>");
        sizes.reals(&mut field, cells);
        field.extend(b";\nboundaryField { \".*\" { type fixedValue; value nonuniform List<vector>");
        sizes.reals(&mut field, &cells[..4]);
        field.extend(b"; } upper { type symmetryPlane; } lower { type noSlip; } }");
        fs::write(folder.path().join("2/U"), field).unwrap();
        let got = latest(folder.path());
        let tolerance = if scalar == 4 { 1e-7 } else { 0.0 };
        let near = |a: &f64, b: &f64| (a - b).abs() <= tolerance;
        assert_eq!(got.mesh.faces, known.mesh.faces);
        assert_eq!((&got.mesh.owner, &got.mesh.neighbour), (&known.mesh.owner, &known.mesh.neighbour));
        assert!(got.mesh.points.iter().flatten().zip(known.mesh.points.iter().flatten()).all(|(a, b)| near(a, b)));
        let (u, on) = values(got.fields.velocity.as_ref());
        assert!(u.iter().flatten().zip(cells.iter().flatten()).all(|(a, b)| near(a, b)));
        assert!(on[..4].iter().flatten().zip(cells[..4].iter().flatten()).all(|(a, b)| near(a, b)));
        // what is said of its sizes must be so
        let owner = folder.path().join("constant/polyMesh/owner");
        let other = String::from_utf8_lossy(&sizes.header("labelList"))
            .replace(&format!("label={}", 8 * label), &format!("label={}", 96 - 8 * label));
        let bytes = fs::read(&owner).unwrap();
        fs::write(&owner, [other.as_bytes(), &bytes[sizes.header("labelList").len()..]].concat()).unwrap();
        let e = refusal(folder.path());
        assert!(e.contains("owner") && e.contains("list"), "{e}");
    }
}
