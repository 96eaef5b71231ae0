//! Setting a key of a file whether it is there or not, as the stages of a scenario do.

use crate::contact::entries;
use crate::overrides::Replacement;
use crate::problem::Problem;
use crate::value::{Entry, Node, Step, Table, Value, split_path};
use pulvis_contact::catalogue::Role;

/// Sets the value at `path`.
pub(crate) fn set(root: &mut Table, path: &str, value: Replacement) -> Result<(), Problem> {
    let unreadable = || Problem::UnreadablePath { path: path.to_owned() };
    let mut steps = split_path(path).ok_or_else(unreadable)?;
    name_contact_as_before(root, &mut steps);
    let mut new = Node { span: 0..0, value: Value::Boolean(false), replaced: false };
    value.apply(&mut new);
    let Some((Step::Key(first), rest)) = steps.split_first() else { return Err(unreadable()) };
    if let [.., Step::Key(role), Step::Key(key)] = rest
        && key == "law"
        && let Some(table) = table_at(root, &steps)
    {
        keep_parameters(table, role, &new);
    }
    let mut node = enter(root, first, &new);
    for step in rest {
        node = match (step, &mut node.value) {
            (Step::Key(key), Value::Table(table)) => enter(table, key, &new),
            (Step::Index(index), Value::List(items)) if *index < items.len() => {
                items.get_mut(*index).ok_or_else(unreadable)?
            }
            (Step::Key(key), _) => {
                return Err(Problem::NothingToReplace { key: key.clone(), similar: None });
            }
            (Step::Index(index), _) => {
                return Err(Problem::NothingToReplace { key: format!("[{index}]"), similar: None });
            }
        };
    }
    *node = new;
    Ok(())
}

/// `contacts.plate-grain` where the file says `[contacts.grain-plate]`.
fn name_contact_as_before(root: &Table, steps: &mut [Step]) {
    let [Step::Key(first), Step::Key(pair), ..] = steps else { return };
    let Some(Value::Table(contacts)) = root.entries.get(first.as_str()).map(|entry| &entry.node.value) else {
        return;
    };
    if let Some((one, other)) = pair.split_once('-') {
        let turned = format!("{other}-{one}");
        if !contacts.entries.contains_key(pair.as_str()) && contacts.entries.contains_key(&turned) {
            *pair = turned;
        }
    }
}

/// The entry of `key`; where there is none, an empty table that stands where the new value does.
fn enter<'t>(table: &'t mut Table, key: &str, new: &Node) -> &'t mut Node {
    let entry = table.entries.entry(key.to_owned()).or_insert_with(|| Entry {
        key_span: new.span.clone(),
        node: Node { span: new.span.clone(), value: Value::Table(Table::default()), replaced: false },
    });
    &mut entry.node
}

/// The table in which the last step of a path stands, if it is there.
fn table_at<'t>(root: &'t mut Table, steps: &[Step]) -> Option<&'t mut Table> {
    let mut table = root;
    for step in steps.split_last()?.1 {
        let Step::Key(key) = step else { return None };
        let Value::Table(inner) = &mut table.entries.get_mut(key)?.node.value else { return None };
        table = inner;
    }
    Some(table)
}

/// Drops the parameters that the new law does not know; of an unknown law it drops none, because the
/// law's name will be refused.
fn keep_parameters(table: &mut Table, role: &str, law: &Node) {
    let Value::Text(name) = &law.value else { return };
    let role = Role::ALL.into_iter().find(|known| known.key() == role);
    let entry = role.and_then(|role| entries(role).into_iter().find(|entry| entry.name == name));
    if let Some(entry) = entry {
        table.entries.retain(|key, _| key == "law" || entry.parameter(key).is_some());
    }
}
