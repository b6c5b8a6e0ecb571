//! What the page is made from.

use crate::claims::Claim;
use crate::fit::Fit;
use crate::properties::Property;
use crate::study::Study;
use crate::sweep::Measure;
use taut::{Laplacian, TimeFormula};

/// All that stands on the page.
#[derive(Debug, Clone, Default)]
pub struct Content<'a> {
    /// What the page is called.
    pub title: String,
    /// A paragraph: what was done and what came out.
    pub summary: String,
    /// Each claim of the paper with its verdict, in the paper's order.
    pub claims: &'a [Claim],
    /// How the page was made: what and its value, as `seed` and `7`.
    pub making: Vec<[String; 2]>,
    /// The basic set, 1.obj first.
    pub basic: &'a [Study],
    /// The models that the formulas are verified on.
    pub models: &'a [Study],
    /// Tables 1 to 4 beside ours.
    pub properties: Vec<Table>,
    /// Figure 5: anisotropy, then standard deviation.
    pub trends: Vec<Trend>,
    /// Tables 6 and 8 beside ours.
    pub best: Vec<Table>,
    /// Tables 7 and 9 with each Laplacian.
    pub correlations: Vec<CorrelationTable>,
    /// Eq. 4 and what leads to it, for each error and each Laplacian.
    pub fits: Vec<FitFigure>,
    /// The basic set drawn again.
    pub draws: Vec<Table>,
    /// Table 5 beside ours.
    pub verification: Vec<Table>,
    /// What makes the numbers differ.
    pub why: Vec<Table>,
    /// Where the errors are.
    pub pictures: Vec<Picture>,
    /// Slips in the paper's numbers.
    pub slips: Vec<Table>,
}

/// Any table.
#[derive(Debug, Clone, Default)]
pub struct Table {
    /// Above it.
    pub title: String,
    /// Below the title: what to see.
    pub note: String,
    /// Names over several columns, and over how many; none, or as many as there are columns in all.
    pub groups: Vec<(String, usize)>,
    /// A name for each column.
    pub head: Vec<String>,
    /// As many cells as there are columns in each; one with fewer ends in a remark, in text only.
    pub rows: Vec<Vec<Cell>>,
}

/// A cell of a table.
#[derive(Debug, Clone, Default)]
pub struct Cell {
    /// What it says.
    pub text: String,
    /// How it looks.
    pub tone: Tone,
}

/// How a cell looks.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub enum Tone {
    /// As text.
    #[default]
    Plain,
    /// Pale: the paper's number, or one of little weight.
    Pale,
    /// Good: better, or the same as the paper's.
    Good,
    /// Bad: worse.
    Bad,
}

impl<T: Into<String>> From<T> for Cell {
    fn from(text: T) -> Cell {
        Cell { text: text.into(), tone: Tone::Plain }
    }
}

impl Cell {
    /// A cell that looks so.
    #[must_use]
    pub fn new(text: impl Into<String>, tone: Tone) -> Cell {
        Cell { text: text.into(), tone }
    }
}

/// A number of the paper, and ours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Beside {
    /// `None` where the paper has none.
    pub paper: Option<f64>,
    /// `None` where there is none.
    pub ours: Option<f64>,
}

impl Table {
    /// The paper's numbers beside ours: two columns for each name in `columns`, whose numbers have so many digits after the
    /// point. Ours are marked where they are the paper's to the last of these digits, rounded or cut.
    #[must_use]
    pub fn beside(title: &str, note: &str, columns: &[(&str, usize)], rows: &[(String, Vec<Beside>)]) -> Table {
        let groups = columns.iter().map(|(name, _)| ((*name).to_owned(), 2));
        let head = columns.iter().flat_map(|_| ["paper", "ours"]);
        let cells = |row: &[Beside]| -> Vec<Cell> {
            row.iter().zip(columns).flat_map(|(numbers, &(_, decimals))| numbers.cells(decimals)).collect()
        };
        Table {
            title: title.to_owned(),
            note: note.to_owned(),
            groups: std::iter::once((String::new(), 1)).chain(groups).collect(),
            head: std::iter::once("model").chain(head).map(str::to_owned).collect(),
            rows: rows.iter().map(|(name, row)| [vec![name.as_str().into()], cells(row)].concat()).collect(),
        }
    }
}

impl Beside {
    fn cells(self, decimals: usize) -> [Cell; 2] {
        let text =
            |number: Option<f64>| number.map_or("–".to_owned(), |number| super::numbers::fixed(number, decimals));
        let unit = 10f64.powi(-(decimals as i32));
        let is_same = self.paper.zip(self.ours).is_some_and(|(paper, ours)| (paper - ours).abs() < unit * (1.0 - 1e-6));
        let tone = if is_same { Tone::Good } else { Tone::Plain };
        [Cell::new(text(self.paper), Tone::Pale), Cell::new(text(self.ours), tone)]
    }
}

/// A property along the basic set.
#[derive(Debug, Clone)]
pub struct Trend {
    /// Which property.
    pub property: Property,
    /// The paper's values, for 1.obj to 5.obj.
    pub paper: Vec<f64>,
    /// Ours.
    pub ours: Vec<f64>,
    /// Through ours, over the numbers 1 to 5.
    pub line: Fit,
}

/// The correlation of the best t with each property, over the basic set.
#[derive(Debug, Clone)]
pub struct CorrelationTable {
    /// Of which error t is the best.
    pub measure: Measure,
    /// With which Laplacian.
    pub laplacian: Laplacian,
    /// The properties in the order of the paper's table.
    pub rows: Vec<CorrelationRow>,
}

/// Pearson's coefficient of one property.
#[derive(Debug, Clone)]
pub struct CorrelationRow {
    /// Which property.
    pub property: Property,
    /// The paper's; `None` where it has none.
    pub paper: Option<f64>,
    /// Ours; `None` where the property or t does not vary.
    pub ours: Option<f64>,
    /// The 95 % confidence interval of ours; `None` where there is none.
    pub interval: Option<[f64; 2]>,
}

/// The regression of the best t on σ.
#[derive(Debug, Clone)]
pub struct FitFigure {
    /// Of which error t is the best.
    pub measure: Measure,
    /// With which Laplacian.
    pub laplacian: Laplacian,
    /// (σ, t) of our basic set.
    pub ours: Vec<[f64; 2]>,
    /// (σ, t) in the paper's tables.
    pub paper: Vec<[f64; 2]>,
    /// Through ours.
    pub line: Fit,
}

/// A picture of the errors on a model.
#[derive(Debug, Clone)]
pub struct Picture {
    /// Which model.
    pub model: String,
    /// Computed with.
    pub laplacian: Laplacian,
    /// At the t of.
    pub formula: TimeFormula,
    /// In percent.
    pub mean_error: f64,
    /// The picture's file.
    pub png: Vec<u8>,
}
