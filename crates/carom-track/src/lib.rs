//! carom-track
