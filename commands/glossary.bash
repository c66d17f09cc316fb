navvi_glossary() { give_lesson glossary "$@"; }
