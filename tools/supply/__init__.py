"""What the project installs: read from the locks, with licences, as a bill of materials."""
