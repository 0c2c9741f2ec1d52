//! Plots: what is drawn is there, what cannot be drawn does no harm.

use std::fs;

use carom_report::plot::{ColorMap, Legend, Marker, Reference};
use carom_report::{Axis, Color, HeatMap, Plot, Report, ReportError, Series, TableError};
#[cfg(feature = "png")]
use tiny_skia::{Pixmap, PremultipliedColorU8};

fn sample() -> Plot {
    let x = [0.1, 0.3, 1.0, 3.0, 10.0];
    Plot::new("Copper <on> glass", Axis::new("speed", "m/s").log(), Axis::new("restitution", "").range(0.0, 1.0))
        .with(Series::line("model", x, [0.2, 0.8, 0.9, 0.92, 0.85]))
        .with(Series::points("measured", x, [0.3, 0.7, 0.9, 0.9, 0.8]).deviation([0.05; 5]).marker(Marker::Square))
        .with(Series::band("5–95 %", x, [0.1, 0.6, 0.8, 0.9, 0.8], [0.4, 0.9, 0.95, 0.95, 0.9]).color(Color::SKY))
        .reference(Reference::vertical(0.2, "capture velocity"))
}

/// How often an element with this start is in the document.
fn count(svg: &str, start: &str) -> usize {
    svg.matches(start).count()
}

/// The document's texts.
fn texts(svg: &str) -> Vec<String> {
    svg.split("<text ")
        .skip(1)
        .filter_map(|t| t.split_once('>'))
        .filter_map(|(_, t)| t.split_once("</text>"))
        .map(|(t, _)| t.trim().to_owned())
        .collect()
}

#[test]
fn svg_holds_its_labels_and_is_the_same_every_time() {
    let svg = sample().svg().unwrap();
    assert_eq!(svg, sample().svg().unwrap());
    assert!(svg.starts_with("<svg width=\"900\" height=\"560\""), "{}", &svg[..120]);
    let texts = texts(&svg);
    for label in [
        "Copper &lt;on&gt; glass",
        "speed (m/s)",
        "restitution",
        "model",
        "measured",
        "5–95 %",
        "capture velocity",
        "0.1",
        "10",
        "0.8",
    ] {
        assert!(texts.iter().any(|t| t == label), "{label} in {texts:?}");
    }
}

#[cfg(feature = "png")]
#[test]
fn png_shows_data_in_their_colours_and_text_without_any_system_font() {
    let small = |title: &str| Plot { size: (360, 240), title: title.to_owned(), legend: Legend::Hidden, ..sample() };
    let png = small("Copper").png().unwrap();
    let pixels = Pixmap::decode_png(&png).unwrap();
    assert_eq!((pixels.width(), pixels.height()), (720, 480));
    let painted = |red, green, blue| {
        let colour = |p: &&PremultipliedColorU8| (p.red(), p.green(), p.blue()) == (red, green, blue);
        pixels.pixels().iter().filter(colour).count()
    };
    assert!(painted(0, 114, 178) > 500, "the line");
    assert!(painted(213, 94, 0) > 300, "the marks");
    assert!(painted(255, 255, 255) > 100_000, "the ground");
    // The title is the only thing in its strip above the frame.
    let dark = |pixels: &Pixmap| pixels.pixels()[..720 * 90].iter().filter(|p| p.red() < 100).count();
    assert!(dark(&pixels) > 300);
    let untitled = small(" ").png().unwrap();
    assert_eq!(dark(&Pixmap::decode_png(&untitled).unwrap()), 0);
    assert_eq!(untitled, small(" ").png().unwrap(), "the same bytes every time");
}

#[cfg(feature = "png")]
#[test]
fn png_text_stands_where_svg_text_does() {
    // one word at the left, reading upwards: its letters' dark pixels lie about the middle of the axis, left of the numbers
    let plot = Plot { size: (360, 240), ..Plot::new("", Axis::new("", ""), Axis::new("restitution", "")) };
    let pixels = Pixmap::decode_png(&plot.png().unwrap()).unwrap();
    let dark = (0..480_usize).flat_map(|y| (0..60_usize).map(move |x| (x, y)));
    let dark: Vec<(usize, usize)> = dark.filter(|(x, y)| pixels.pixels()[y * 720 + x].red() < 100).collect();
    let extent = |pick: fn(&(usize, usize)) -> usize| {
        (dark.iter().map(pick).min().unwrap(), dark.iter().map(pick).max().unwrap())
    };
    let ((left, right), (top, bottom)) = (extent(|p| p.0), extent(|p| p.1));
    // 15 CSS pixels of font: letters rise 11.4 above the baseline at 22; the word is 75 pixels long
    assert!((2 * 9..2 * 12).contains(&left) && (2 * 21..=2 * 23).contains(&right), "{left} to {right}");
    assert!((2 * 68..2 * 78).contains(&(bottom - top)), "{top} to {bottom}");
}

#[test]
fn extension_chooses_the_format_and_others_are_refused_before_anything_is_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    sample().write(path("a.svg")).unwrap();
    let small = Plot { size: (90, 60), ..sample() };
    if cfg!(feature = "png") {
        small.write(path("a.PNG")).unwrap();
        assert_eq!(&fs::read(path("a.PNG")).unwrap()[..4], b"\x89PNG");
    } else {
        let error = small.write(path("a.PNG")).unwrap_err().to_string();
        assert!(error.ends_with("this build writes no PNG; build it with the feature `png`"), "{error}");
    }
    assert_eq!(fs::read_to_string(path("a.svg")).unwrap(), sample().svg().unwrap());
    let error = sample().write(path("a.pdf")).unwrap_err();
    assert!(matches!(error, ReportError::Table(TableError::UnknownExtension { .. })));
    assert!(error.to_string().ends_with("known are .svg and .png"), "{error}");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), if cfg!(feature = "png") { 2 } else { 1 });
}

#[test]
fn log_axes_leave_out_what_is_not_positive() {
    let plot = |x: [f64; 5]| {
        Plot::new("", Axis::new("x", "").log(), Axis::new("y", "").log())
            .with(Series::points("", x, [1.0, 2.0, 3.0, 4.0, 5.0]))
            .svg()
            .unwrap()
    };
    assert_eq!(count(&plot([1.0, 2.0, 3.0, 4.0, 5.0]), "<circle"), 5);
    assert_eq!(count(&plot([-1.0, 0.0, 3.0, 4.0, 5.0]), "<circle"), 3);
    assert_eq!(count(&plot([f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -0.0, 5.0]), "<circle"), 1);
    assert_eq!(count(&plot([0.0; 5]), "<circle"), 0);
}

#[test]
fn nan_breaks_a_line_and_a_band() {
    let lines = |y: [f64; 5]| {
        let plot = Plot::new("", Axis::new("", ""), Axis::new("", ""))
            .with(Series::line("", [0.0, 1.0, 2.0, 3.0, 4.0], y).color(Color(1, 2, 3)));
        count(&plot.svg().unwrap(), "stroke=\"#010203\"")
    };
    assert_eq!(lines([0.0, 1.0, 2.0, 1.0, 0.0]), 1);
    assert_eq!(lines([0.0, 1.0, f64::NAN, 1.0, 0.0]), 2);
    assert_eq!(lines([f64::NAN; 5]), 0);
    let bands = |low: [f64; 5]| {
        let plot = Plot::new("", Axis::new("", ""), Axis::new("", "")).with(Series::band(
            "",
            [0.0, 1.0, 2.0, 3.0, 4.0],
            low,
            [3.0; 5],
        ));
        count(&plot.svg().unwrap(), "<polygon")
    };
    assert_eq!(bands([1.0; 5]), 1);
    assert_eq!(bands([1.0, 1.0, f64::NAN, 1.0, 1.0]), 2);
}

#[test]
fn bars_and_error_bars_are_drawn_on_both_scales() {
    for y in [Axis::new("", ""), Axis::new("", "").log()] {
        let bars = Plot::new("", Axis::new("", ""), y.clone()).with(Series::bars(
            "",
            [0.0, 1.0, 2.0, 3.0],
            [5.0, f64::NAN, 2.0],
        ));
        assert_eq!(count(&bars.svg().unwrap(), "<polygon"), 2, "{y:?}");
        let points = |interval: bool| {
            let series = Series::points("", [1.0, 2.0], [2.0, 3.0]).color(Color(1, 2, 3));
            let series = if interval { series.interval([1.0, -1.0], [3.0, 4.0]) } else { series };
            let plot = Plot::new("", Axis::new("", ""), y.clone()).with(series);
            count(&plot.svg().unwrap(), "stroke=\"#010203\"")
        };
        assert_eq!(points(false), 0);
        // A bar and two caps each.
        assert_eq!(points(true), 6, "{y:?}");
    }
}

#[test]
fn empty_and_odd_input_draws_without_panic() {
    let log = || Axis::new("", "").log();
    let linear = || Axis::new("", "");
    let values: [&[f64]; 6] =
        [&[], &[1.0], &[f64::NAN, f64::NAN], &[f64::INFINITY, 1.0], &[f64::MAX, f64::MIN], &[5e-324, 1e-320]];
    for (x, y) in [(linear(), linear()), (log(), linear()), (linear(), log()), (log().range(-1.0, 0.0), log())] {
        for v in values {
            let v = v.to_vec();
            for legend in [Legend::Auto, Legend::Outside, Legend::LowerLeft] {
                let plot = Plot::new("t", x.clone(), y.clone())
                    .with(Series::line("a", v.clone(), v.clone()).dashed())
                    .with(Series::points("b", v.clone(), v.clone()).deviation(v.clone()))
                    .with(Series::band("c", v.clone(), v.clone(), v.clone()))
                    .with(Series::bars("d", v.clone(), v.iter().skip(1).copied().collect::<Vec<_>>()))
                    .reference(Reference::horizontal(f64::NAN, "nan"))
                    .reference(Reference::vertical(0.0, "zero"))
                    .wall([f64::NAN, 0.0], [1.0, 1.0])
                    .legend(legend);
                plot.svg().unwrap();
                plot.clone().equal_aspect().svg().unwrap();
            }
        }
    }
    for size in [(0, 0), (1, 1), (50, 2000)] {
        Plot { size, ..sample() }.svg().unwrap();
    }
    #[cfg(feature = "png")]
    Plot { size: (0, 0), ..sample() }.png().unwrap();
}

#[test]
fn arrays_of_different_lengths_are_refused_by_name() {
    let plot = |series| Plot::new("", Axis::new("", ""), Axis::new("", "")).with(series).svg();
    for (series, what) in [
        (Series::line("a", [1.0, 2.0], [1.0]), "1 ordinates where 2"),
        (Series::points("a", [1.0, 2.0], [1.0, 2.0]).interval([1.0], [2.0]), "1 error bars where 2"),
        (Series::band("a", [1.0], [1.0], [1.0, 2.0]), "2 upper ordinates where 1"),
        (Series::bars("a", [1.0, 2.0], [1.0, 2.0]), "2 heights where 1"),
    ] {
        let message = plot(series).unwrap_err().to_string();
        assert!(message.contains("series \"a\"") && message.contains(what), "{message}");
    }
}

#[test]
fn lines_are_cut_at_the_frame() {
    let plot = Plot::new("", Axis::new("", "").range(0.0, 1.0), Axis::new("", "").range(0.0, 1.0))
        .with(Series::line("", [-1e9, 1e9], [-1e9, 1e9]).color(Color(1, 2, 3)));
    let svg = plot.svg().unwrap();
    let line = svg.lines().find(|l| l.contains("#010203")).unwrap();
    let points = line.split("points=\"").nth(1).unwrap();
    for number in points.trim_end_matches(" \"/>").split([',', ' ']).filter(|n| !n.is_empty()) {
        assert!((0.0..=9000.0).contains(&number.parse::<f64>().unwrap()), "{line}");
    }
}

#[test]
fn equal_aspect_makes_a_circle_round() {
    let angle = (0..=72).map(|i| f64::from(i) * 5.0_f64.to_radians());
    // whatever units the axes are shown in
    for factor in [1.0, 1e3, 1e-3] {
        let plot = Plot::new("", Axis::new("", ""), Axis::scaled("", "", factor))
            .with(
                Series::line("", angle.clone().map(f64::cos), angle.clone().map(|a| 3.0 + a.sin()))
                    .color(Color(1, 2, 3)),
            )
            .equal_aspect();
        round(&plot.svg().unwrap());
    }
}

fn round(svg: &str) {
    let line = svg.lines().find(|l| l.contains("#010203")).unwrap();
    let points: Vec<(f64, f64)> = line
        .split("points=\"")
        .nth(1)
        .unwrap()
        .split(' ')
        .filter_map(|p| p.split_once(','))
        .map(|(x, y)| (x.parse().unwrap(), y.parse().unwrap()))
        .collect();
    let extent = |pick: fn(&(f64, f64)) -> f64| {
        let (low, high) = points.iter().map(pick).fold((f64::MAX, f64::MIN), |(l, h), v| (l.min(v), h.max(v)));
        high - low
    };
    let (width, height) = (extent(|p| p.0), extent(|p| p.1));
    assert!((width - height).abs() <= 2.0 && width > 3000.0, "{width} {height}");
}

#[test]
fn automatic_legend_takes_a_corner_free_of_data_else_the_outside() {
    let frame = |series: Series, legend| {
        Plot::new("", Axis::new("", "").range(0.0, 1.0), Axis::new("", "").range(0.0, 1.0))
            .with(series)
            .legend(legend)
            .svg()
            .unwrap()
    };
    let rising = || Series::line("a", [0.0, 1.0], [0.0, 1.0]);
    assert_eq!(frame(rising(), Legend::Auto), frame(rising(), Legend::UpperLeft));
    let falling = || Series::line("a", [0.0, 1.0], [1.0, 0.0]);
    assert_eq!(frame(falling(), Legend::Auto), frame(falling(), Legend::UpperRight));
    let everywhere = || Series::band("a", [0.0, 1.0], [0.0, 0.0], [1.0, 1.0]);
    assert_eq!(frame(everywhere(), Legend::Auto), frame(everywhere(), Legend::Outside));
    assert!(!texts(&frame(rising(), Legend::Hidden)).contains(&"a".to_owned()));
}

#[test]
fn heat_map_colours_cells_by_value() {
    let map = |values: [f64; 4]| {
        HeatMap::new("m", Axis::new("x", "m"), Axis::new("y", "m"), Axis::scaled("mass", "mg", 1e6)).cells(
            [0.0, 1.0, 2.0],
            [0.0, 1.0, 2.0],
            values,
        )
    };
    let svg = map([0.0, 1e-6, f64::NAN, 2e-6]).svg().unwrap();
    assert_eq!(svg, map([0.0, 1e-6, f64::NAN, 2e-6]).svg().unwrap());
    assert!(svg.contains("#E1E1E1"), "a cell without value is grey");
    assert!(texts(&svg).contains(&"mass (mg)".to_owned()));
    assert!(!map([0.0, 1e-6, 1e-6, 2e-6]).svg().unwrap().contains("#E1E1E1"));
    // The lowest value is viridis' dark end, as is the colour bar's foot.
    assert!(count(&svg, "fill=\"#440154\"") >= 1);
    let diverging = map([-1e-6, 0.0, 0.0, 0.5e-6]).colors(ColorMap::Diverging).svg().unwrap();
    assert!(diverging.contains("#0072B2") && diverging.contains("#F7F7F7"));
    let message = HeatMap { values: vec![1.0], ..map([0.0; 4]) }.svg().unwrap_err().to_string();
    assert_eq!(message, "heat map \"m\": 1 values for 2 × 2 cells");
    let empty = HeatMap::new("", Axis::new("", "").log(), Axis::new("", ""), Axis::new("", "").log());
    empty.svg().unwrap();
}

#[test]
fn report_escapes_text_and_asks_for_nothing_outside() {
    let mut report = Report::new("<script>alert('a & b')</script>");
    report.section("S \"q\"").paragraph("1 < 2 & 3 > 2").list(["<i>"]).preformatted("a<b");
    report.figure(&sample().svg().unwrap(), "caption \"with\" <quotes>");
    let html = report.html();
    assert!(!html.contains("<script") && !html.contains("<i>"));
    assert!(html.contains("<p>1 &lt; 2 &amp; 3 &gt; 2</p>"));
    assert!(html.contains("aria-label=\"caption &quot;with&quot; &lt;quotes&gt;\""));
    assert_eq!(count(&html, "<svg "), 1);
    for outside in ["src=", "href=", "url(", "@import", "<link"] {
        assert!(!html.contains(outside), "{outside}");
    }
    let error = report.write("report.htm").unwrap_err().to_string();
    assert!(error.ends_with("known are .html"), "{error}");
}
