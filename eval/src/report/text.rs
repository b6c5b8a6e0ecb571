//! A table for a terminal.

use super::{Cell, Table};
use std::fmt::Write;

impl Table {
    /// The table with its columns one below the other: the first to the left, as words are, the others to the right. The
    /// last cell of a row that is too short is a remark, which takes the rest of the line.
    #[must_use]
    pub fn text(&self) -> String {
        let head: Vec<Cell> = self.head.iter().map(|name| name.as_str().into()).collect();
        let rows: Vec<&[Cell]> = std::iter::once(&head[..]).chain(self.rows.iter().map(Vec::as_slice)).collect();
        let is_remark = |row: &[Cell], column: usize| column + 1 == row.len() && row.len() < head.len();
        let width = |column: usize| {
            let columns = rows.iter().filter(|row| !is_remark(row, column)).filter_map(|row| row.get(column));
            columns.map(|cell| cell.text.chars().count()).max().unwrap_or(0)
        };
        let widths: Vec<usize> = (0..self.head.len()).map(width).collect();
        let mut text = format!("{}\n", self.title);
        if !self.note.is_empty() {
            text += &format!("{}\n", self.note);
        }
        text += &self.over(&widths);
        for row in rows {
            let mut line = String::new();
            for (column, (cell, &width)) in row.iter().zip(&widths).enumerate() {
                let gap = if column == 0 { "" } else { "  " };
                // Writing to a string cannot fail.
                let _ = match column {
                    _ if is_remark(row, column) => write!(line, "{gap}{}", cell.text),
                    0 => write!(line, "{gap}{:<width$}", cell.text),
                    _ => write!(line, "{gap}{:>width$}", cell.text),
                };
            }
            text += line.trim_end();
            text.push('\n');
        }
        text
    }

    /// The line of names that stand over several columns.
    fn over(&self, widths: &[usize]) -> String {
        let mut line = String::new();
        let mut first = 0;
        for (name, count) in &self.groups {
            let columns = widths.iter().skip(first).take(*count);
            let width: usize = columns.map(|width| width + 2).sum();
            let _ = write!(line, "{name:>width$}"); // writing to a string cannot fail
            first += count;
        }
        // The first column has no gap before it.
        let line: String = line.chars().skip(2).collect();
        if line.trim().is_empty() { String::new() } else { line.trim_end().to_owned() + "\n" }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_stand_one_below_the_other() {
        let table = Table {
            title: "T".to_owned(),
            note: "n".to_owned(),
            groups: vec![(String::new(), 1), ("both".to_owned(), 2)],
            head: ["model", "ē", "t"].map(str::to_owned).into(),
            rows: vec![
                ["a", "1.5", "20"].map(Cell::from).into(),
                ["longer", "2", ""].map(Cell::from).into(),
                ["b", "refused, as it is"].map(Cell::from).into(),
            ],
        };
        let expected =
            "T\nn\n           both\nmodel     ē   t\na       1.5  20\nlonger    2\nb       refused, as it is\n";
        assert_eq!(table.text(), expected);
    }
}
