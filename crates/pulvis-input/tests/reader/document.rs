//! Loading files, showing mistakes, and replacing values.

use crate::schema;
use pulvis_input::*;
use std::path::Path;

const SCENARIO: &str = include_str!("good/everything.toml");

fn document() -> Document {
    Document::from_str("tablet.toml", SCENARIO).unwrap()
}

fn temporary(name: &str, bytes: &[u8]) -> std::path::PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("document");
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join(name);
    std::fs::write(&path, bytes).unwrap();
    path
}

fn refusal(path: &Path) -> InputErrors {
    Document::load(path).unwrap_err()
}

#[test]
fn a_mistake_is_shown_with_its_line_and_underlined() {
    let text = "[contacts.grain.normal]\n\tk1 = \"100 N/m\" # loading\n\tkp = \"50 N/s\"\n";
    let errors = Document::from_str("tablet.toml", text)
        .unwrap()
        .read(|mut root| {
            let mut contacts = root.required_table("contacts")?;
            let mut grain = contacts.required_table("grain")?;
            let mut normal = grain.required_table("normal")?;
            let k1 = normal.required("k1", Dimension::STIFFNESS);
            let kp = normal.required("kp", Dimension::STIFFNESS);
            [normal, grain, contacts, root].into_iter().for_each(TableReader::finish);
            Ok((k1?, kp?))
        })
        .unwrap_err();
    assert_eq!(
        errors.to_string(),
        "error: tablet.toml:3:7: contacts.grain.normal.kp: \"50 N/s\" is a quantity in [kg^1 m^1 s^-3], \
         expected a stiffness [N/m]; write for example \"50 N/m\"\n\
         \x20|\n\
         3| \tkp = \"50 N/s\"\n\
         \x20| \t     ^^^^^^^^"
    );
}

#[test]
fn an_unknown_key_comes_with_the_known_ones() {
    let errors = Document::from_str("a.toml", "radius = \"1 mm\"\nmas = 3")
        .unwrap()
        .read(|mut root| {
            let radius = root.required("radius", Dimension::LENGTH);
            let mass = root.optional("mass", Dimension::MASS);
            root.finish();
            Ok((radius?, mass?))
        })
        .unwrap_err();
    assert_eq!(
        errors.to_string(),
        "error: a.toml:2:1: mas: unknown key; did you mean `mass`?\n\
         \x20|\n2| mas = 3\n | ^^^\n  help: known keys here: radius, mass"
    );
}

#[test]
fn no_more_than_twenty_mistakes_are_shown() {
    let text: String = (0..25).map(|number| format!("key{number} = 1\n")).collect();
    let read = Document::from_str("a.toml", &text).unwrap().read(|root| {
        root.finish();
        Ok(())
    });
    let errors = read.unwrap_err();
    assert_eq!((errors.errors().len(), errors.omitted()), (20, 5));
    assert!(errors.to_string().ends_with("5 more mistakes are not shown"));
}

#[test]
fn a_table_whose_keys_were_not_checked_is_not_passed_over() {
    let errors = document().read(|mut root| root.optional("title", Text)).unwrap_err();
    assert!(errors.to_string().contains("this is a bug in Pulvis"), "{errors}");
}

#[test]
fn a_file_that_cannot_be_read_says_why() {
    let good = temporary("tablet.toml", SCENARIO.as_bytes());
    assert!(schema::load(&good).is_ok());
    let with_mark = temporary("mark.toml", &[b"\xef\xbb\xbf", SCENARIO.as_bytes()].concat());
    assert!(schema::load(&with_mark).is_ok());

    let missing = good.with_file_name("tabelt.toml");
    let errors = refusal(&missing);
    assert!(matches!(errors.errors()[0].problem, Problem::NoSuchFile));
    let help = format!("did you mean `{}`?", good.display());
    assert_eq!(errors.errors()[0].help.as_ref(), Some(&help));
    let shown = format!("error: {}: there is no such file\n  help: {help}", missing.display());
    assert_eq!(errors.to_string(), shown);

    assert!(matches!(refusal(good.parent().unwrap()).errors()[0].problem, Problem::Folder));
    assert!(matches!(refusal(&temporary("empty.toml", b"")).errors()[0].problem, Problem::Empty));
    assert!(matches!(
        refusal(&temporary("binary.toml", b"\0\xff")).errors()[0].problem,
        Problem::NotText { .. }
    ));
    let large = vec![b'#'; (16 << 20) + 1];
    assert!(matches!(
        refusal(&temporary("large.toml", &large)).errors()[0].problem,
        Problem::TooLarge { .. }
    ));
}

#[test]
fn a_file_cut_off_anywhere_is_read_or_refused_but_never_breaks_the_reader() {
    for end in (0..SCENARIO.len()).filter(|&end| SCENARIO.is_char_boundary(end)) {
        let read = Document::from_str("cut.toml", &SCENARIO[..end]).and_then(|cut| cut.read(schema::case));
        if let Err(errors) = read {
            assert!(!errors.to_string().is_empty());
        }
    }
}

#[test]
fn a_forgotten_pair_of_quotes_gets_advice() {
    let errors = Document::from_str("a.toml", "[contact]\nk1 = 100 N/m # loading").unwrap_err();
    let help = errors.errors()[0].help.as_deref();
    assert_eq!(help, Some("a quantity with its unit stands in quotes: k1 = \"100 N/m\""));
}

#[test]
fn a_sweep_replaces_a_value_in_si() {
    let replaced = document().with_override("contact.k1", Replacement::Si(120.0)).unwrap();
    assert_eq!(replaced.read(schema::case).unwrap().k1, 120.0);
    let replaced = replaced.with_override("stages[1].duration", "5 ms").unwrap();
    let replaced =
        replaced.with_override("materials.\"glass beads\".friction", Replacement::parse("0")).unwrap();
    let replaced = replaced.with_override("radius[0]", "2 um").unwrap();
    let case = replaced.read(schema::case).unwrap();
    assert_eq!((case.k1, case.stages[1].duration, case.radius[0]), (120.0, 5e-3, 2e-6));
    assert_eq!(case.materials[0], ("glass beads".to_owned(), 2500.0, 0.0));
    assert_eq!(document().read(schema::case).unwrap().k1, 100.0, "the original stays as it is");
}

#[test]
fn a_bad_replacement_is_blamed_on_the_outside_not_on_the_line() {
    let replaced = document().with_override("contact.kp", Replacement::Si(50.0)).unwrap();
    let errors = replaced.read(schema::case).unwrap_err();
    assert_eq!(
        errors.to_string(),
        "error: tablet.toml:8:6: contact.kp: 50 N/m is smaller than k1 = 100 N/m; expected kp >= k1\n\
         \x20|\n8| kp = \"0.5 kN/m\"\n |      ^^^^^^^^^^\n\
         \x20 note: this value was set from outside the file; the line shows what it replaces"
    );
}

#[test]
fn a_value_of_the_file_can_replace_another_and_keeps_its_own_place() {
    let text = "a = \"1 mm\"\nset = \"2 s\"";
    let document = Document::from_str("a.toml", text).unwrap();
    let set = document.read(|mut root| {
        let set = root.value("set").map(|value| value.replacement());
        root.value("a");
        root.finish();
        Ok(set)
    });
    let replaced = document.with_override("a", set.unwrap().unwrap()).unwrap();
    let errors = replaced.read(|mut root| root.required("a", Dimension::LENGTH)).unwrap_err();
    assert_eq!(
        errors.errors()[0].headline(),
        "2:7: a: \"2 s\" is a time [s], expected a length [m]; write for example \"2 mm\""
    );
}

#[test]
fn a_replacement_that_leads_nowhere_is_refused() {
    let headline = |path: &str| match document().with_override(path, Replacement::Si(1.0)) {
        Ok(_) => panic!("{path} was accepted"),
        Err(errors) => errors.errors()[0].headline(),
    };
    assert_eq!(
        headline("contact.interpolaton"),
        "5:1: contact: there is no key `interpolaton` to replace; did you mean `interpolation`?"
    );
    assert_eq!(headline("contcat.k1"), "there is no key `contcat` to replace; did you mean `contact`?");
    assert_eq!(headline("stages[2].name"), "18:1: stages: there is no key `[2]` to replace");
    assert_eq!(headline("contact"), "5:1: contact: is a table; expected a single value to replace");
    assert_eq!(headline("radius"), "2:10: radius: is a list; expected a single value to replace");
    assert_eq!(headline("contact.k1.x"), "7:6: contact.k1: there is no key `x` to replace");
    for path in ["", ".", "contact.", "contact..k1", "stages[", "stages[x]", "a\"b", "\"a", "[0]"] {
        assert!(document().with_override(path, "1").is_err(), "{path}");
    }
}

#[test]
fn what_is_typed_on_a_command_line_becomes_number_truth_or_text() {
    assert_eq!(Replacement::parse("3"), Replacement::Integer(3));
    assert_eq!(Replacement::parse("2.5e-3"), Replacement::Number(2.5e-3));
    assert_eq!(Replacement::parse("true"), Replacement::Boolean(true));
    assert_eq!(Replacement::parse("5 mm"), Replacement::Text("5 mm".into()));
    assert_eq!(Replacement::parse("\"3\""), Replacement::Text("3".into()));
}
