//! A board at a serial port.

use super::{LinkError, Transport};
use std::time::Duration;

/// What the firmware's UART is set to.
const BAUD: u32 = 921_600;

/// An open serial port.
pub struct SerialPort(Box<dyn serialport::SerialPort>);

impl SerialPort {
    /// Opens a port, such as `/dev/ttyUSB0` or `COM3`.
    ///
    /// # Errors
    /// [`LinkError::Io`].
    pub fn open(path: &str) -> Result<Self, LinkError> {
        serialport::new(path, BAUD)
            .timeout(Duration::from_secs(1))
            .open()
            .map(Self)
            .map_err(|error| LinkError::Io { what: path.to_owned(), source: error.into() })
    }
}

impl Transport for SerialPort {
    fn send(&mut self, bytes: &[u8]) -> Result<(), LinkError> {
        self.0
            .write_all(bytes)
            .map_err(|source| LinkError::Io { what: "serial port".into(), source })
    }

    fn receive(&mut self, patience: Duration) -> Result<Vec<u8>, LinkError> {
        let failed = |source| LinkError::Io { what: "serial port".into(), source };
        self.0.set_timeout(patience).map_err(|error| failed(error.into()))?;
        let mut buffer = vec![0; 512];
        match self.0.read(&mut buffer) {
            Ok(received) => {
                buffer.truncate(received);
                Ok(buffer)
            }
            Err(error) if error.kind() == std::io::ErrorKind::TimedOut => {
                Err(LinkError::Silent(patience))
            }
            Err(source) => Err(failed(source)),
        }
    }
}
