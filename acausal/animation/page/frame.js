// Fill the frame of an animation in a notebook with its page, as soon as the notebook has the player.
((id, player, content) => {
  const show = () => {
    const pieces = window.acausalPlayers?.[player];
    if (!pieces) return;
    removeEventListener("acausal-player", show);
    const page = pieces.map((piece, k) => (k % 2 ? content[piece] : piece)).join("");
    for (const frame of document.querySelectorAll(`[id="${id}"]`)) frame.srcdoc = page;
  };
  addEventListener("acausal-player", show);
  show();
})
