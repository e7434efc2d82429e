// The worker of the playground. README.md has the messages.
self.onmessage = ({ data }) => {
  if (data.to === 'start') {
    self.postMessage({ from: 'failed', kind: 'absent', text: 'this copy of the site was made without the engine' });
  }
};
