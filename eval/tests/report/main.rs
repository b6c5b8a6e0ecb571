//! The page: everything is on it, whatever is studied, and a browser needs nothing else. And the tables to compute with.

mod synthetic;

use taut::{Laplacian, TimeFormula, TimeScale};
use taut_eval::report::{Content, Table, html, write_best, write_gains, write_properties, write_sweeps};
use taut_eval::{FormulaGain, Interval, Outcome, Ratios, Study};

const EVIL: &str = "<script>alert('x')</script>\"&amp;\u{1f40d}, a\nb";

fn whole_page() -> String {
    let (basic, models) = (synthetic::basic(), synthetic::models());
    html(&synthetic::content(&basic, &models, &synthetic::claims()))
}

/// Every tag that opens closes, in order; attributes are quoted, names are defined once, links lead to one.
fn check(page: &str) {
    const VOID: [&str; 3] = ["meta", "img", "br"];
    let (mut open, mut ids, mut links) = (Vec::new(), Vec::new(), Vec::new());
    let (doctype, rest) = page.split_once('>').unwrap();
    assert_eq!(doctype, "<!DOCTYPE html");
    for piece in rest.split('<').skip(1) {
        let (tag, text) = piece.split_once('>').expect("a tag has an end");
        assert!(tag == "style" || !text.contains('>'), "{tag}");
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name));
            continue;
        }
        let name = tag.split([' ', '\n', '/']).next().unwrap();
        assert!(tag.matches('"').count().is_multiple_of(2), "{tag}");
        let attribute =
            |key: &str| tag.split_once(&format!(" {key}=\"")).and_then(|(_, rest)| Some(rest.split_once('"')?.0));
        ids.extend(attribute("id"));
        links.extend(attribute("href").map(|link| link.strip_prefix('#').expect("links stay on the page")));
        if !VOID.contains(&name) && !tag.ends_with('/') {
            open.push(name);
        }
    }
    assert!(open.is_empty(), "{open:?}");
    let count = |id: &str| ids.iter().filter(|&&other| other == id).count();
    assert!(ids.iter().all(|id| count(id) == 1), "{ids:?}");
    assert!(links.iter().all(|link| count(link) == 1), "{links:?} of {ids:?}");
}

/// What stands between two sections.
fn section<'a>(page: &'a str, anchor: &str) -> &'a str {
    let start = page.find(&format!("<section id=\"{anchor}\"")).unwrap_or_else(|| panic!("no {anchor}"));
    let end = page[start..].find("</section>").unwrap();
    &page[start..start + end]
}

#[test]
fn every_part_is_there_in_order() {
    let page = whole_page();
    check(&page);
    let order = [
        "claims",
        "making",
        "properties",
        "best",
        "search",
        "correlation",
        "verification-set",
        "verification",
        "units",
        "why",
        "pictures",
        "models",
        "slips",
        "verdicts",
    ];
    let places: Vec<usize> =
        order.iter().map(|anchor| page.find(&format!("<section id=\"{anchor}\"")).unwrap()).collect();
    assert!(places.is_sorted(), "{places:?}");
    let holds = |anchor, what: &str| assert!(section(&page, anchor).contains(what), "{anchor}: {what}");
    for number in [10, 11, 12, 13, 14, 15] {
        holds("verification", &format!("Figure {number}."));
    }
    holds("properties", "Figure 5.");
    holds("best", "Figure 9.");
    for name in synthetic::MODELS {
        holds("models", &format!(">{name}</th>"));
        holds("search", &format!(">{name}</th>"));
        holds("best", &format!("mean error over t / ē² on {name}</title>"));
    }
    let plots = page.matches("<svg").count();
    // Two trends, two Figures 9, one for each model, two correlations, four fits, six figures of gains and steps, one of units.
    assert_eq!(plots, 2 + 2 + 70 + 2 + 4 + 6 + 1);
    assert_eq!(page.matches("role=\"img\"").count(), plots);
    assert_eq!(page.matches("<img").count(), page.matches("alt=\"Errors on ").count());
}

#[test]
fn the_same_content_gives_the_same_bytes() {
    assert_eq!(whole_page(), whole_page());
}

#[test]
fn nothing_is_loaded() {
    let page = whole_page().replace("xmlns=\"http://www.w3.org/2000/svg\"", "");
    for outside in ["http:", "https:", "\"//", "url(", "@import", "<link", "<script", "<iframe"] {
        assert!(!page.contains(outside), "{outside}");
    }
    assert!(page.split(" src=\"").skip(1).all(|source| source.starts_with("data:image/png;base64,iVBORw0KGgo")));
}

#[test]
fn names_are_text_whatever_they_hold() {
    let (basic, models) = ([synthetic::study(EVIL, 1)], [synthetic::study(EVIL, 2)]);
    let mut claims = synthetic::claims();
    claims.truncate(1);
    let claim = &mut claims[0];
    let ours = &mut claim.judgements[0].ours;
    for text in [&mut claim.id, &mut claim.text, &mut claim.paper, &mut claim.rule, ours] {
        EVIL.clone_into(text);
    }
    let mut content = synthetic::content(&basic, &models, &claims);
    content.title = EVIL.to_owned();
    content.summary = EVIL.to_owned();
    content.making = vec![[EVIL.to_owned(), EVIL.to_owned()]];
    content.pictures.iter_mut().for_each(|picture| EVIL.clone_into(&mut picture.model));
    content.why = vec![Table {
        title: EVIL.to_owned(),
        note: EVIL.to_owned(),
        groups: vec![(EVIL.to_owned(), 1)],
        head: vec![EVIL.to_owned()],
        rows: vec![vec![EVIL.into()]],
    }];
    let page = html(&content);
    check(&page);
    assert!(!page.contains("<script"));
    assert!(page.contains("&lt;script"));
}

#[test]
fn letters_are_large_enough() {
    let page = whole_page();
    // Drawings have four units to a pixel.
    let sizes = page.split("font-size=\"").skip(1).map(|rest| rest.split('"').next().unwrap().parse::<f64>().unwrap());
    assert!(sizes.map(|size| size / 4.0).all(|size| size >= 11.0));
}

/// A study all of whose figures are one number.
fn flat(name: &str, value: f64) -> Study {
    let mut study = synthetic::study(name, 1);
    study.properties.mean_edge = value;
    study.properties.sigma = value;
    study.properties.anisotropy = None;
    let interval = Interval { ratio: value, low: value, high: value };
    let ratios = Ratios { mean: interval, median: interval };
    for of in &mut study.laplacians {
        for point in &mut of.sweep.points {
            (point.t, point.mean, point.median) = (value, value, value);
        }
        for best in of.search.iter_mut().chain([&mut of.sweep.mean, &mut of.sweep.median]) {
            (best.t, best.error, best.maximum_t) = (value, value, Some(value));
        }
        for gain in &mut of.formulas {
            let over =
                Outcome { t: value, mean: value, median: value, over_vertices: ratios, over_sources: Some(ratios) };
            gain.outcome = Ok(over);
        }
    }
    study
}

#[test]
fn whatever_was_found_is_drawn_or_said_to_be_left_out() {
    let values =
        [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, -1.0, 1.0, 1e-300, 1e300, f64::MAX, f64::MIN_POSITIVE];
    let all: Vec<Study> = values.iter().map(|&value| flat("flat", value)).collect();
    let each = all.iter().map(std::slice::from_ref).chain([&all[..], &[]]);
    for studies in each {
        let claims = synthetic::claims();
        let mut content = synthetic::content(studies, studies, &claims);
        for trend in &mut content.trends {
            trend.ours.iter_mut().zip(values).for_each(|(ours, value)| *ours = value);
            trend.line.slope.value = values[studies.len() % values.len()];
        }
        for fit in &mut content.fits {
            fit.ours = values.iter().map(|&value| [value, value]).collect();
            fit.line.intercept.value = f64::NAN;
        }
        for of in &mut content.correlations {
            of.rows
                .iter_mut()
                .zip(values)
                .for_each(|(row, value)| (row.ours, row.interval) = (Some(value), Some([value; 2])));
        }
        let page = html(&content);
        check(&page);
        assert!(!page.contains("NaN") && !page.contains(">inf"));
        assert!(page.contains("not shown"));
    }
    check(&html(&Content::default()));
}

#[test]
fn a_gain_that_is_no_number_is_left_out_and_one_without_end_is_at_the_edge() {
    for (value, is_left_out) in [(f64::NAN, true), (f64::INFINITY, false)] {
        let models = [flat("flat", value)];
        let page = html(&synthetic::content(&[], &models, &synthetic::claims()));
        let (_, figure) = page.split_once("<strong>Figure 10.").unwrap();
        let (figure, _) = figure.split_once("</figure>").unwrap();
        assert_eq!(figure.contains("not shown"), is_left_out, "{value}");
        // With each Laplacian.
        assert_eq!(figure.matches("−∞").count(), if is_left_out { 0 } else { 2 });
    }
}

#[test]
fn studies_of_one_laplacian_or_of_none_are_shown() {
    let mut models = synthetic::models();
    models.truncate(3);
    models[0].laplacians.clear();
    models[1].laplacians.remove(0);
    models[2].laplacians.remove(0);
    models[2].laplacians[0].formulas.clear();
    let page = html(&synthetic::content(&[], &models, &synthetic::claims()));
    check(&page);
    let verification = section(&page, "verification");
    assert!(verification.contains("intrinsic Delaunay") && !verification.contains("plain cotangents"));
    models.iter_mut().for_each(|study| study.laplacians.clear());
    check(&html(&synthetic::content(&models, &models, &synthetic::claims())));
}

/// A study whose Eq. 2 has this ratio in the mean error with plain cotangents.
fn of_ratio(name: &str, ratio: f64) -> Study {
    let mut study = synthetic::study(name, 3);
    let interval = Interval { ratio, low: ratio - 0.1, high: ratio + 0.1 };
    let is_asked = |gain: &&mut FormulaGain| gain.formula == TimeFormula::Sigma && gain.scale == TimeScale::Paper;
    for of in study.laplacians.iter_mut().filter(|of| of.laplacian == Laplacian::Plain) {
        for gain in of.formulas.iter_mut().filter(is_asked) {
            let outcome = gain.outcome.as_mut().unwrap();
            outcome.over_vertices.mean = interval;
            outcome.over_sources = None;
        }
    }
    study
}

#[test]
fn gains_are_counted_sorted_and_marked_at_the_edge() {
    let models = [of_ratio("worse", 1.3), of_ratio("far worse", 6.0), of_ratio("best", 0.5), of_ratio("unsure", 1.05)];
    let page = html(&synthetic::content(&[], &models, &synthetic::claims()));
    let verification = section(&page, "verification");
    let (_, row) = verification.split_once(">Figure 10: Eq. 2, mean</th>").unwrap();
    let cells: Vec<&str> =
        row.split("<td").skip(1).take(3).map(|cell| cell.split(['>', '<']).nth(1).unwrap()).collect();
    assert_eq!(cells, ["21 / 10 / 4", "1 / 2 / 1", "0 / 0 / 0"]);
    let (_, figure) = verification.split_once("<strong>Figure 10.").unwrap();
    let places = ["best", "unsure", "worse", "far worse"].map(|name| figure.find(&format!(">\n{name}\n<")).unwrap());
    assert!(places.is_sorted(), "{places:?}");
    let (figure, _) = figure.split_once("</figure>").unwrap();
    assert_eq!(figure.matches("−500\u{202f}%").count(), 1);
}

fn records(table: &[u8]) -> (Vec<String>, Vec<Vec<String>>) {
    let mut reader = csv::Reader::from_reader(table);
    let own = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect::<Vec<_>>();
    let head = own(reader.headers().unwrap());
    (head, reader.records().map(|record| own(&record.unwrap())).collect())
}

/// The cell of a row under a name.
fn cell<'a>(head: &[String], row: &'a [String], name: &str) -> &'a str {
    &row[head.iter().position(|column| column == name).unwrap_or_else(|| panic!("no {name} in {head:?}"))]
}

fn value(head: &[String], row: &[String], name: &str) -> f64 {
    cell(head, row, name).parse().unwrap()
}

#[test]
fn tables_hold_every_number_to_the_last_bit() {
    let mut studies = vec![synthetic::study(EVIL, 5), synthetic::study("plain", 6)];
    studies[0].properties.anisotropy = None;
    studies[0].laplacians[0].formulas[3].outcome = Err("too small".to_owned());
    let write = |write: &dyn Fn(&mut Vec<u8>) -> std::io::Result<()>| {
        let mut table = Vec::new();
        write(&mut table).unwrap();
        records(&table)
    };

    let (head, rows) = write(&|out| write_properties(studies.iter().map(|of| (&*of.model, &of.properties)), out));
    assert_eq!(rows.len(), 2);
    assert_eq!(cell(&head, &rows[0], "model"), EVIL);
    assert_eq!(cell(&head, &rows[0], "anisotropy"), "");
    let p = &studies[1].properties;
    let expected = [("anisotropy", p.anisotropy.unwrap()), ("sigma", p.sigma), ("q3", p.q3), ("scale", p.scale)];
    expected.iter().for_each(|&(name, expected)| assert_eq!(value(&head, &rows[1], name), expected, "{name}"));
    assert_eq!(cell(&head, &rows[1], "vertices"), p.vertices.to_string());
    assert_eq!(cell(&head, &rows[1], "quartile_deviation"), p.quartile_deviation.to_string());

    let (head, rows) = write(&|out| write_sweeps(&studies, out));
    let points = studies.iter().flat_map(|study| &study.laplacians).flat_map(|of| &of.sweep.points);
    assert_eq!(rows.len(), points.clone().count());
    for (row, point) in rows.iter().zip(points) {
        let values = ["t", "mean_error_percent", "median_error_percent"].map(|name| value(&head, row, name));
        assert_eq!(values, [point.t, point.mean, point.median]);
    }

    let (head, rows) = write(&|out| write_best(&studies, out));
    assert_eq!(rows.len(), 2 * 2 * 2 * 2);
    let of = &studies[0].laplacians[1];
    let row = rows.iter().find(|row| row[..4] == [EVIL, "intrinsic", "median", "search"]).unwrap();
    assert_eq!([value(&head, row, "t"), value(&head, row, "error_percent")], [of.search[1].t, of.search[1].error]);

    let (head, rows) = write(&|out| write_gains(&studies, out));
    assert_eq!(rows.len(), 2 * 2 * 10);
    assert_eq!(cell(&head, &rows[3], "refused"), "too small");
    assert_eq!(cell(&head, &rows[3], "t"), "");
    let row = &rows[22];
    assert_eq!(row[..4], ["plain", "plain", "mean-sigma", "paper"]);
    let outcome = studies[1].laplacians[0].formulas[2].outcome.as_ref().unwrap();
    assert_eq!(value(&head, row, "median_high_over_sources"), outcome.over_sources.unwrap().median.high);
    assert_eq!(value(&head, row, "mean_low_over_vertices"), outcome.over_vertices.mean.low);
    assert_eq!(value(&head, row, "t_over_mean_edge_squared"), outcome.t / (p.mean_edge * p.mean_edge));
}
