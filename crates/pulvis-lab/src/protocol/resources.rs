//! What the machine has left: memory and room on its disks.

use std::fs;
use std::path::Path;

/// A size [byte] in memory or on a disk, in words.
pub fn size_in_words(size: u64) -> String {
    let size = size as f64;
    match size {
        size if size < 1e3 => format!("{size:.0} B"),
        size if size < 1e6 => format!("{:.1} kB", size / 1e3),
        size if size < 1e9 => format!("{:.1} MB", size / 1e6),
        size => format!("{:.2} GB", size / 1e9),
    }
}

/// Memory that this process can still have [byte]: what the system says is available, less where a control
/// group or the user's limits allow less; `None` where the system does not say.
pub(super) fn available_memory() -> Option<u64> {
    let read = |path: &str| fs::read_to_string(path).ok();
    let system = read("/proc/meminfo").and_then(|text| kilobytes(&text, "MemAvailable:"));
    let address_space = read("/proc/self/limits").and_then(|text| {
        let used = kilobytes(&read("/proc/self/status")?, "VmSize:")?;
        Some(address_space_limit(&text)?.saturating_sub(used))
    });
    let group = |limit: &str, used: &str| {
        let number = |path| read(path)?.trim().parse::<u64>().ok();
        Some(number(limit)?.saturating_sub(number(used)?))
    };
    let version_2 = group("/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory.current");
    let version_1 =
        group("/sys/fs/cgroup/memory/memory.limit_in_bytes", "/sys/fs/cgroup/memory/memory.usage_in_bytes");
    [system, address_space, version_2, version_1].into_iter().flatten().min()
}

/// The value [byte] of a line such as `MemAvailable:   1024 kB`.
fn kilobytes(text: &str, name: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()?.checked_mul(1024)
}

/// The limit of the address space [byte] that /proc/self/limits tells, if there is one.
fn address_space_limit(text: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix("Max address space"))?;
    line.split_whitespace().next()?.parse().ok()
}

/// Room for the files of a folder that need not exist yet [byte]; `None` where the system does not say.
pub(super) fn free_disk_space(folder: &Path) -> Option<u64> {
    let above = |path: &&Path| path.as_os_str().is_empty() || path.exists();
    let existing = folder.ancestors().find(above)?;
    let existing = if existing.as_os_str().is_empty() { Path::new(".") } else { existing };
    fs4::available_space(existing).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_read_well() {
        assert_eq!(size_in_words(999), "999 B");
        assert_eq!(size_in_words(1_500_000), "1.5 MB");
        assert_eq!(size_in_words(12_340_000_000), "12.34 GB");
    }

    #[test]
    fn the_texts_of_the_system_are_understood() {
        let meminfo = "MemTotal:       24689252 kB\nMemFree:  3 kB\nMemAvailable:   22000000 kB\n";
        assert_eq!(kilobytes(meminfo, "MemAvailable:"), Some(22_000_000 * 1024));
        assert_eq!(kilobytes(meminfo, "VmSize:"), None);
        let limits = "Limit    Soft Limit  Hard Limit  Units\nMax address space         4096000              unlimited            bytes\n";
        assert_eq!(address_space_limit(limits), Some(4_096_000));
        assert_eq!(address_space_limit("Max address space   unlimited   unlimited   bytes"), None);
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn this_machine_says_what_it_has_left() {
        assert!(available_memory().is_some_and(|bytes| bytes > 1 << 20));
        assert!(free_disk_space(Path::new("target/not/yet/there")).is_some());
    }
}
