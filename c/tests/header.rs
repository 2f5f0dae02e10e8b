//! `include/surefoot.h` is what the interface says. With `SUREFOOT_WRITE_HEADER` set it is written.

use cbindgen::{Builder, Config, EnumConfig, ExportConfig, Language, RenameRule, Style};

/// Names in C.
const NAMES: [(&str, &str); 8] = [
    ("SurefootCommand", "surefoot_command"),
    ("SurefootController", "surefoot_controller"),
    ("SurefootLimit", "surefoot_limit"),
    ("SurefootMeasurement", "surefoot_measurement"),
    ("SurefootMode", "surefoot_mode"),
    ("SurefootSettings", "surefoot_settings"),
    ("SurefootStatus", "surefoot_status"),
    ("SurefootStop", "surefoot_stop"),
];

const PREAMBLE: &str = "/* Balance control for legged robots. Made from the Rust sources by a test of the crate:\n   \
                        change those. SUREFOOT_LEGS and SUREFOOT_JOINTS are the robot's, in surefoot_robot.h,\n   \
                        which is made with the library. */";

#[test]
fn the_header_is_the_interface() {
    let folder = env!("CARGO_MANIFEST_DIR");
    let config = Config {
        language: Language::C,
        header: Some(PREAMBLE.to_owned()),
        include_guard: Some("SUREFOOT_H".to_owned()),
        includes: vec!["surefoot_robot.h".to_owned()],
        // Those that a compiler has without a library.
        no_includes: true,
        sys_includes: ["stdbool.h", "stddef.h", "stdint.h"].map(str::to_owned).into(),
        cpp_compat: true,
        style: Style::Type,
        line_length: 100,
        usize_is_size_t: true,
        documentation: true,
        enumeration: EnumConfig {
            rename_variants: RenameRule::QualifiedScreamingSnakeCase,
            ..EnumConfig::default()
        },
        export: ExportConfig {
            rename: NAMES.map(|(from, to)| (from.to_owned(), to.to_owned())).into(),
            exclude: ["SUREFOOT_LEGS", "SUREFOOT_JOINTS", "LEG", "NONE", "MADE"]
                .map(str::to_owned)
                .into(),
            ..ExportConfig::default()
        },
        ..Config::default()
    };
    let mut builder = Builder::new().with_config(config);
    for file in
        ["lib", "status", "settings", "measurement", "command", "controller", "robot", "version"]
    {
        builder = builder.with_src(format!("{folder}/src/{file}.rs"));
    }
    let mut header = Vec::new();
    builder.generate().expect("an interface of C").write(&mut header);
    let path = format!("{folder}/include/surefoot.h");
    if std::env::var_os("SUREFOOT_WRITE_HEADER").is_some() {
        std::fs::write(&path, &header).expect("written");
    }
    let current = std::fs::read_to_string(&path).expect("the header");
    assert!(
        current == String::from_utf8(header).expect("text"),
        "the header is of another interface: run this test with SUREFOOT_WRITE_HEADER=1"
    );
}
