//! A board at a serial port.

use super::{LinkError, Transport};
use std::io::{Error, ErrorKind};
use std::time::Duration;
use surefoot_link::BAUD;

/// How long the port may take to send a frame, which it does in milliseconds.
const PATIENCE: Duration = Duration::from_secs(1);

/// An open serial port.
pub struct SerialPort {
    port: Box<dyn serialport::SerialPort>,
    path: String,
}

impl SerialPort {
    /// Opens a port, such as `/dev/ttyUSB0` or `COM3`, for this program alone.
    ///
    /// # Errors
    /// [`LinkError::Io`].
    pub fn open(path: &str) -> Result<Self, LinkError> {
        let opened = serialport::new(path, BAUD).timeout(PATIENCE).open();
        let port = opened.map_err(|error| LinkError::Io {
            what: format!("serial port {path}, at {BAUD} baud"),
            source: error.into(),
        })?;
        Ok(Self { port, path: path.to_owned() })
    }

    fn failed(&self, source: Error) -> LinkError {
        LinkError::Io { what: format!("serial port {}", self.path), source }
    }
}

impl Transport for SerialPort {
    fn send(&mut self, bytes: &[u8]) -> Result<(), LinkError> {
        self.port.write_all(bytes).map_err(|error| match error.kind() {
            ErrorKind::TimedOut => {
                let what = "the port takes no bytes; is its adapter held back by flow control?";
                self.failed(Error::new(ErrorKind::TimedOut, what))
            }
            _ => self.failed(error),
        })
    }

    fn receive(&mut self, patience: Duration) -> Result<Vec<u8>, LinkError> {
        self.port.set_timeout(patience).map_err(|error| self.failed(error.into()))?;
        let mut buffer = vec![0; 512];
        match self.port.read(&mut buffer) {
            // The end of a port is that of its adapter.
            Ok(0) => Err(LinkError::Ended(format!("{}: unplugged?", self.path))),
            Ok(received) => {
                buffer.truncate(received);
                Ok(buffer)
            }
            Err(error) if error.kind() == ErrorKind::TimedOut => Err(LinkError::Silent(patience)),
            Err(error) if error.kind() == ErrorKind::Interrupted => Ok(Vec::new()),
            Err(error) if error.kind() == ErrorKind::BrokenPipe => {
                Err(LinkError::Ended(format!("{}: unplugged?", self.path)))
            }
            Err(source) => Err(self.failed(source)),
        }
    }
}
