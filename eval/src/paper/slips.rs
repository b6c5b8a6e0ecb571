//! Where the paper contradicts itself.

/// A number or a sentence that cannot be right.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Slip {
    /// Where it stands.
    pub place: &'static str,
    /// What stands there.
    pub printed: &'static str,
    /// Why it cannot be, and what would fit.
    pub note: &'static str,
}

/// All that are known, in the order of the paper.
pub const SLIPS: [Slip; 11] = [
    Slip {
        place: "Section 4.1, recipe",
        printed: "n · 3 % of the vertices, n the mesh's number",
        note: "(n - 1) · 3 %, as Figure 2 has it; by Table 1 it is 0, 3.1, 6.2, 10.0 and 12.7 %",
    },
    Slip {
        place: "Table 1, 4.obj",
        printed: "12863 vertices, 38582 edges, 25720 faces",
        note: "twice the edges is 4 more than three times the faces, and V - E + F = 1: there is a hole of four edges, which \
               no other mesh of the set has",
    },
    Slip {
        place: "Table 2, D_e",
        printed: "median absolute deviation",
        note: "these are mean absolute deviations: 1.obj has 0.0196; its median absolute deviation is 0.0156",
    },
    Slip {
        place: "Table 5, (28) teapot, max_e",
        printed: "0.1318",
        note: "the longest edge is shorter than the mean edge, 0.483; 1.318 would fit",
    },
    Slip {
        place: "Table 5, (29) torso, Var(e)",
        printed: "0.1114",
        note: "the square of the standard deviation, 0.105, is 0.0110; 0.0111 would fit",
    },
    Slip {
        place: "Section 5.1.3, Figure 10",
        printed: "for 10 models it allows to obtain lower mean errors",
        note: "by the text these are the models where Eq. 1 is better; Eq. 2 is for 21",
    },
    Slip {
        place: "Section 5.1.4, Figure 12",
        printed: "average of standard deviation and average edge length",
        note: "Eq. 3 is the average of the standard deviation and of the square of the average edge length",
    },
    Slip {
        place: "Section 5.2.2",
        printed: "standard deviation: 96 % positive correlation",
        note: "Table 9 has 0.9113, and Tables 2 and 8 give it; 0.9593 is for the mean error",
    },
    Slip {
        place: "Table 9, max_e",
        printed: "0.8956",
        note: "Tables 3 and 8 give 0.9267, more than for the standard deviation (0.9114): the strongest correlation with the \
               best t for the median error is that of the longest edge",
    },
    Slip { place: "Table 9, ē", printed: "0.86", note: "Tables 2 and 8 give 0.8610: the third digit is lost" },
    Slip {
        place: "Figure 15",
        printed: "dividing two mean approximation error values",
        note: "by the text it shows median errors",
    },
];
